#include "sim/gaze_generator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sim/eye_tracker.h"
#include "sim/person.h"

namespace gazeloop::sim {

gaze::GazeTrace generate_gaze(const GazeSimulation& simulation, double seconds) {
    gaze::GazeTrace trace;
    trace.file = "generated";
    trace.format = "gazeloop";
    trace.device = fmt::format("simulated tracker, seed {}", simulation.seed);
    const TrackerTerms& terms = simulation.tracker;
    const auto count =
        static_cast<std::uint64_t>(std::max(1.0, std::floor(seconds * terms.rate_hz)));
    const bool on_arrival = terms.delay_ms > 0.0 || terms.jitter_ms > 0.0;

    Person person(simulation.eye, simulation.head, simulation.seed);
    EyeTracker tracker(terms, simulation.seed, 0);
    for (std::uint64_t i = 0; i < count && !tracker.finished(); ++i) {
        if (auto sample = tracker.step(person)) {
            if (!on_arrival) {
                sample->arrived = {};
            }
            trace.samples.push_back(*sample);
        }
    }
    return trace;
}

}  // namespace gazeloop::sim
