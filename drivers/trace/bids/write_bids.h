#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runtime/error.h"
#include "runtime/gaze/gaze_trace.h"

namespace gazeloop::drivers {

/// What BIDS calls the recording; letters and digits alone.
struct BidsLabels {
    std::string subject = "01";
    std::string task = "gaze";
};

struct WrittenBids {
    std::vector<std::filesystem::path> files;
    std::vector<std::string> left_out;  ///< what of the trace is not in them, in words
};

/// Writes a trace into `folder`, a data set of BIDS 1.11 (made if there is none, and added to if
/// there is one), as sub-SUBJECT/beh/sub-SUBJECT_task-TASK_recording-eye1_physio.tsv.gz and eye2
/// with their sidecars: eye-in-head, azimuth and elevation in degrees, times in ns since the first
/// sample. A trace with one ray for both eyes is one recording, of the cyclopean eye. What BIDS has
/// no column for stands in columns of our own, described in the sidecar (read_bids). Where gaze is
/// lost, *_physioevents.tsv.gz has an event "loss".
///
/// Files of this recording are replaced, and those of eyes that it no longer has removed, which is
/// said. Errors: Usage for a label with anything else in it; BadInput for a
/// trace of fewer than two samples with known times, a file that cannot be written.
[[nodiscard]] Expected<WrittenBids> write_bids(const gaze::RecordingView& trace,
                                               const std::filesystem::path& folder,
                                               const BidsLabels& labels = {});

}  // namespace gazeloop::drivers
