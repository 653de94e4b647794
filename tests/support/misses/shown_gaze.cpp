#include "tests/support/misses/shown_gaze.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "drivers/simulated/simulated_source.h"
#include "runtime/gaze/direction.h"

namespace gazeloop::tests {
namespace {

constexpr double kSettled_s = 2.0;
constexpr double kPupilCovered = 0.7;  // as sim::EyeTracker has it

gaze::StereoView around(const gaze::Pose& head, const gaze::StereoView& views) {
    gaze::StereoView placed = views;
    for (gaze::EyeView& view : placed) {
        view.pose = gaze::compose(head, view.pose);
    }
    return placed;
}

}  // namespace

std::vector<ShownGaze> shown_gaze(const sim::GazeSimulation& person, const Headset& headset,
                                  const gaze::FoveaPolicy& policy, double seconds) {
    drivers::SimulatedSource source(person, 0);
    gaze::GazeToFovea foveae(policy);
    std::vector<gaze::GazeSample> samples;
    std::vector<ShownGaze> shown;
    const auto frames = static_cast<std::int64_t>(seconds * headset.refresh_hz);
    const auto at_ns = [&](std::int64_t frame) {
        return std::llround(static_cast<double>(frame) * 1e9 / headset.refresh_hz);
    };
    for (std::int64_t frame = 1; frame < frames; ++frame) {
        const std::int64_t latched_ns = at_ns(frame);
        const std::int64_t display_ns = at_ns(frame + 1);
        samples.clear();
        source.poll(latched_ns, samples);
        for (const gaze::GazeSample& sample : samples) {
            foveae.add(sample);
        }
        const sim::TrueGaze truth = source.truth_at(display_ns);
        const gaze::StereoView views = around(truth.head, headset.views);
        const gaze::FrameFovea fovea =
            foveae.latch({latched_ns, time::StampKind::Modelled}, truth.head, views,
                         {display_ns, time::StampKind::Modelled});
        if (static_cast<double>(display_ns) < kSettled_s * 1e9) {
            continue;
        }
        for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
            const gaze::FoveaPoint& point = fovea.eyes[eye];
            const glm::dvec3 looked =
                glm::conjugate(headset.views[eye].pose.orientation) * truth.eyes[eye].direction;
            shown.push_back(
                {.error_deg = glm::degrees(gaze::angle_between(looked, point.direction)),
                 .widening_deg = glm::degrees(point.uncertainty_rad.value_or(0.0)),
                 .in_flight = truth.movement == sim::Movement::Saccade,
                 .covered = truth.eyes[eye].openness < kPupilCovered});
        }
    }
    return shown;
}

}  // namespace gazeloop::tests
