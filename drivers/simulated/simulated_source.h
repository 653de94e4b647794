#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/gaze_source.h"
#include "runtime/gaze/head_motion.h"
#include "sim/arriving_samples.h"
#include "sim/gaze_simulation.h"
#include "sim/person.h"

namespace gazeloop::drivers {

/// A simulated person with an eye tracker (sim/). Samples are made when they are polled, and are
/// the same however often that happens: time is an argument. All times are Modelled. A poll costs
/// time in proportion to the time since the last one.
class SimulatedSource final : public GazeSource {
  public:
    /// The first sample is taken at `start_ns` (host time).
    SimulatedSource(const sim::GazeSimulation& simulation, std::int64_t start_ns);

    void poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) override;
    /// Null if the simulated head stands still: then the real one's motion, if any, is unknown
    /// here.
    [[nodiscard]] const gaze::HeadMotion* head_track() const override;
    /// Where host time, int64 nanoseconds, ends.
    [[nodiscard]] bool finished() const override { return arriving_.finished(); }
    [[nodiscard]] std::string description() const override;

    /// What the eyes truly do at a host time; before the start, what they do at the start.
    [[nodiscard]] sim::TrueGaze truth_at(std::int64_t time_ns);

  private:
    class Head final : public gaze::HeadMotion {
      public:
        Head(sim::Person& person, std::int64_t start_ns) : person_(person), start_ns_(start_ns) {}
        [[nodiscard]] gaze::Pose at(std::int64_t time_ns) const override;

      private:
        sim::Person& person_;  // plans ahead when it is asked
        std::int64_t start_ns_;
    };

    sim::GazeSimulation simulation_;
    std::int64_t start_ns_;
    sim::Person person_;
    Head head_;
    sim::ArrivingSamples arriving_;
};

}  // namespace gazeloop::drivers
