#include "tests/bench/persons_gaze.h"

#include <fmt/core.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "sim/gaze_generator.h"
#include "tests/bench/swept.h"

namespace gazeloop::bench {
namespace {

constexpr std::uint64_t kSeed = 11;

gaze::GazeTrace person(PersonsGaze gaze, double frame_seconds) {
    sim::GazeSimulation simulation{.seed = kSeed};
    simulation.tracker.rate_hz = 1.0 / frame_seconds;
    simulation.eye.blinks_per_min = 0.0;
    if (gaze == PersonsGaze::InFixation) {
        simulation.eye.saccade_deg = 0.0;
    }
    constexpr double kSeconds = 10.0;
    return sim::generate_gaze(simulation, kSeconds);
}

std::size_t first_frame(const gaze::GazeTrace& trace, PersonsGaze gaze, std::size_t frames) {
    constexpr std::size_t kBefore = 6;
    constexpr std::size_t kLater = 4;
    if (gaze == PersonsGaze::InFixation) {
        return 0;
    }
    for (std::size_t at = kBefore; at + frames < trace.samples.size(); ++at) {
        const glm::dvec3 from = trace.samples[at].eyes[0].direction;
        const glm::dvec3 to = trace.samples[at + kLater].eyes[0].direction;
        if (glm::dot(from, to) < std::cos(glm::radians(4.0))) {
            return at - kBefore;
        }
    }
    throw SetupError(ErrorKind::Usage, "the simulated person makes no saccade");
}

}  // namespace

trade::CaseQuestion seen_by_person(std::string_view scene, PersonsGaze gaze, std::size_t frames,
                                   double frame_seconds) {
    trade::CaseQuestion of_case = still(scene, frames);
    of_case.gaze = fmt::format("simulated, seed {}", kSeed);
    const gaze::GazeTrace trace = person(gaze, frame_seconds);
    const std::size_t first = first_frame(trace, gaze, frames);
    of_case.heads.resize(frames);
    for (std::size_t frame = 0; frame < frames; ++frame) {
        const gaze::GazeSample& sample = trace.samples.at(first + frame);
        of_case.directions[frame] = {sample.eyes[0].direction, sample.eyes[1].direction};
        of_case.heads[frame] = sample.head.value_or(gaze::Pose{});
    }
    return of_case;
}

}  // namespace gazeloop::bench
