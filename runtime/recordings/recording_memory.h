#pragma once

#include <spdlog/spdlog.h>

#include <cstddef>

#include "runtime/memory/long_memory.h"

namespace gazeloop::recordings {

/// While it lives, gaze on file is read, judged and written in memory that its length does not
/// change: what is more than this lies in scratch files.
class RecordingMemory {
  public:
    RecordingMemory() : limit_(kBytes) {}

    /// Warns where scratch files were of no use. After what is read was read.
    void warn() const {
        if (const std::string doubt = limit_.doubt(); !doubt.empty()) {
            spdlog::warn("{}", doubt);
        }
    }

  private:
    /// What the clocks of some ten minutes of 1 kHz take, which are judged as a whole.
    static constexpr std::size_t kBytes = std::size_t{128} << 20U;

    memory::MemoryLimit limit_;
};

}  // namespace gazeloop::recordings
