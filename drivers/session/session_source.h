#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "drivers/gaze_source.h"
#include "runtime/session/cursor.h"

namespace gazeloop::drivers {

/// The gaze of a recorded session, given out again exactly as the recorded frames consumed it: each
/// sample at the latch of its frame. It is read from the local file as the loop asks for
/// it. Throws SetupError (BadInput) if that fails.
class SessionSource final : public GazeSource {
  public:
    /// `sample_count`: how many samples the session's frames consumed, for the description. The
    /// session must outlive this.
    SessionSource(const session::OpenSession& session, std::uint64_t sample_count);

    void poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) override;
    /// Samples are as they were recorded: with a head pose, or without one on purpose.
    [[nodiscard]] bool fixed_in_head() const override { return true; }
    [[nodiscard]] bool finished() const override { return !more_; }
    [[nodiscard]] std::string description() const override;

  private:
    void next();

    std::string file_;
    std::uint64_t sample_count_;
    session::SampleCursor samples_;  ///< at the next one to give out
    session::FrameCursor frames_;    ///< at the frame that consumed it
    bool more_ = true;
};

}  // namespace gazeloop::drivers
