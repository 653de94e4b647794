#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/error.h"
#include "runtime/gaze/gaze_trace.h"

namespace gazeloop::drivers {

/// Makes a trace from a file's rows and enforces what gaze_trace.h promises.
class TraceBuilder {
  public:
    TraceBuilder(std::string file, std::string_view format, std::string_view device);

    /// Takes a sample whose `sampled` is relative to any one origin. Drops and counts it if its
    /// time is not later than that of the sample before.
    void add(const gaze::GazeSample& sample);

    /// The trace. Errors (BadInput): no sample was added; none of them has a valid eye.
    [[nodiscard]] Expected<gaze::GazeTrace> finish();

  private:
    gaze::GazeTrace trace_;
    std::optional<std::uint64_t> sequence_;  ///< of the row before, dropped or not
    bool any_valid_ = false;
};

}  // namespace gazeloop::drivers
