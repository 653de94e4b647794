#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "drivers/gaze_source.h"

namespace gazeloop::drivers {

/// The gaze of a recorded session, handed over again exactly as the recorded frames consumed it.
class SessionSource final : public GazeSource {
  public:
    struct Sample {
        std::int64_t consumed_ns = 0;  ///< latch time of the frame that consumed it
        gaze::GazeSample sample;
    };
    /// Precondition: consumed_ns does not decrease.
    SessionSource(std::string file, std::vector<Sample> samples);

    void poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) override;
    /// Samples come as they were recorded: with a head pose, or on purpose without.
    [[nodiscard]] bool fixed_in_head() const override { return true; }
    [[nodiscard]] bool finished() const override { return next_ == samples_.size(); }
    [[nodiscard]] std::string description() const override;

  private:
    std::string file_;
    std::vector<Sample> samples_;
    std::size_t next_ = 0;
};

}  // namespace gazeloop::drivers
