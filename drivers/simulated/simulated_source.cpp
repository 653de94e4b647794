#include "drivers/simulated/simulated_source.h"

#include <fmt/format.h>

namespace gazeloop::drivers {
namespace {

/// Seconds since the start, 0 before it. Any two times: a signed difference could overflow.
double elapsed_s(std::int64_t start_ns, std::int64_t time_ns) {
    if (time_ns <= start_ns) {
        return 0.0;
    }
    return static_cast<double>(static_cast<std::uint64_t>(time_ns) -
                               static_cast<std::uint64_t>(start_ns)) *
           1e-9;
}

}  // namespace

SimulatedSource::SimulatedSource(const sim::GazeSimulation& simulation, std::int64_t start_ns)
    : simulation_(simulation),
      start_ns_(start_ns),
      person_(simulation.eye, simulation.head, simulation.seed),
      head_(person_, start_ns),
      arriving_(sim::EyeTracker(simulation.tracker, simulation.seed, start_ns)) {}

void SimulatedSource::poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) {
    arriving_.take(now_ns, samples,
                   [this](sim::EyeTracker& tracker) { return tracker.step(person_); });
}

const gaze::HeadMotion* SimulatedSource::head_track() const {
    return person_.head_moves() ? &head_ : nullptr;
}

gaze::Pose SimulatedSource::Head::at(std::int64_t time_ns) const {
    return person_.head_at(elapsed_s(start_ns_, time_ns));
}

sim::TrueGaze SimulatedSource::truth_at(std::int64_t time_ns) {
    return person_.at(elapsed_s(start_ns_, time_ns));
}

std::string SimulatedSource::description() const {
    const sim::TrackerTerms& tracker = simulation_.tracker;
    return fmt::format("simulated tracker ({} Hz, delay {} ms, noise {} deg, seed {})",
                       tracker.rate_hz, tracker.delay_ms, tracker.noise_deg, simulation_.seed);
}

}  // namespace gazeloop::drivers
