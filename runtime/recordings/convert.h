#pragma once

#include <string>

#include "drivers/trace/bids/write_bids.h"
#include "drivers/trace/read_options.h"

namespace gazeloop::recordings {

/// Gaze that is to be written in another format.
struct Conversion {
    std::string in;               ///< a trace or a session
    std::string out;              ///< a file; of BIDS a folder
    std::string to = "gazeloop";  ///< "gazeloop", "angles" or "bids"
    drivers::ReadOptions read{};
    drivers::BidsLabels labels{};
    bool labelled = false;  ///< the labels were asked for, which only BIDS has
    std::string json;       ///< what was read and written; "-": stdout; empty: not asked for
};

/// Reads and writes, and says on stdout what was read, written and left out, unless JSON goes
/// there. In memory that the length does not change (recording_memory.h). @throws SetupError: Usage
/// for outputs that are not apart, BadInput for what cannot be read or written
void convert(const Conversion& conversion);

}  // namespace gazeloop::recordings
