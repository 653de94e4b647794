#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "drivers/simulated/simulated_source.h"
#include "runtime/gaze/direction.h"

namespace gazeloop::drivers {
namespace {

/// Every term off, at its least, at its greatest or somewhere between.
sim::GazeSimulation any_simulation() {
    sim::GazeSimulation simulation;
    simulation.seed = *rc::gen::element<std::uint64_t>(
        0, 1, std::numeric_limits<std::uint64_t>::max(), *rc::gen::arbitrary<std::uint64_t>());
    for (const sim::Term& term : sim::terms_of(simulation)) {
        const double share = *rc::gen::inRange(0, 1001) * 1e-3;
        switch (*rc::gen::inRange(0, 4)) {
            case 0:
                *term.value = term.least;
                break;
            case 1:
                *term.value = term.greatest;
                break;
            case 2:
                *term.value = term.least + share * (term.greatest - term.least);
                break;
            default:
                break;  // as built in
        }
    }
    return simulation;
}

RC_GTEST_PROP(SimulatedGaze, IsSoundWithAnyTerms, ()) {
    const sim::GazeSimulation simulation = any_simulation();
    const std::int64_t start_ns = *rc::gen::element<std::int64_t>(
        0, 1'000'000'000'000, std::numeric_limits<std::int64_t>::min(),
        std::numeric_limits<std::int64_t>::max() - 500'000'000);
    SimulatedSource source(simulation, start_ns);
    std::vector<gaze::GazeSample> samples;
    source.poll(start_ns + 500'000'000, samples);
    const gaze::GazeSample* before = nullptr;
    for (const gaze::GazeSample& sample : samples) {
        RC_ASSERT(sample.arrived.ns >= sample.sampled.ns);
        RC_ASSERT(sample.arrived.ns <= start_ns + 500'000'000);
        RC_ASSERT(sample.sampled.ns >= start_ns);
        for (const gaze::EyeRay& ray : sample.eyes) {
            RC_ASSERT(gaze::is_finite(ray.direction));
            RC_ASSERT(std::abs(glm::length(ray.direction) - 1.0) < 1e-12);
            RC_ASSERT(ray.openness == -1.0 || (ray.openness >= 0.0 && ray.openness <= 1.0));
        }
        if (sample.head) {
            RC_ASSERT(std::abs(glm::length(sample.head->orientation) - 1.0) < 1e-9);
            RC_ASSERT(gaze::is_finite(sample.head->position_m));
        }
        if (before != nullptr) {
            RC_ASSERT(sample.sequence > before->sequence);
            RC_ASSERT(sample.sampled.ns > before->sampled.ns);
            RC_ASSERT(sample.arrived.ns >= before->arrived.ns);
        }
        before = &sample;
    }
}

RC_GTEST_PROP(SimulatedGaze, IsTheSameHoweverItIsPolled, ()) {
    const sim::GazeSimulation simulation = any_simulation();
    SimulatedSource at_once(simulation, 0);
    SimulatedSource in_steps(simulation, 0);
    std::vector<gaze::GazeSample> a;
    std::vector<gaze::GazeSample> b;
    std::int64_t now_ns = 0;
    while (now_ns < 1'000'000'000) {
        now_ns += *rc::gen::inRange<std::int64_t>(5'000'000, 200'000'000);
        in_steps.poll(now_ns, b);
        if (const gaze::HeadMotion* const head = in_steps.head_track()) {
            (void)head->at(now_ns + *rc::gen::inRange<std::int64_t>(-50'000'000, 50'000'000));
        }
    }
    at_once.poll(now_ns, a);
    RC_ASSERT(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        RC_ASSERT(a[i].sequence == b[i].sequence);
        RC_ASSERT(a[i].arrived == b[i].arrived);
        for (std::size_t eye = 0; eye < 2; ++eye) {
            RC_ASSERT(a[i].eyes[eye].direction == b[i].eyes[eye].direction);
            RC_ASSERT(a[i].eyes[eye].valid == b[i].eyes[eye].valid);
        }
        if (a[i].head) {
            RC_ASSERT(a[i].head->orientation == b[i].head->orientation);
        }
    }
}

}  // namespace
}  // namespace gazeloop::drivers
