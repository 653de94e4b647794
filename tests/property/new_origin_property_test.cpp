#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <random>
#include <vector>

#include "drivers/trace/trace_source.h"
#include "runtime/gaze/gaze_to_fovea.h"
#include "runtime/gaze/origin_watch.h"

namespace gazeloop::gaze {
namespace {

// Somebody looks about, blinks, and moves the head, while the origin that heads are given in jumps.
// Beside it the same without a jump: what the foveae are to be.

constexpr std::int64_t kRow_ns = 8'333'333;
constexpr std::int64_t kPeriod_ns = 11'111'111;
constexpr double kTurn_deg_s = 20.0;  ///< of the head, about each of two axes
constexpr double kFixation_m = 1.5;

class Person {
  public:
    explicit Person(std::uint64_t seed) : random_(seed) {}

    [[nodiscard]] Pose head(std::int64_t time_ns) const {
        const double s = static_cast<double>(time_ns) * 1e-9;
        const double swing = glm::radians(kTurn_deg_s) / 3.0;
        return {glm::angleAxis(swing * std::sin(3.0 * s), glm::dvec3{0.0, 1.0, 0.0}) *
                    glm::angleAxis(swing * std::cos(3.0 * s), glm::dvec3{1.0, 0.0, 0.0}),
                {0.1, 1.6, 0.2}};
    }

    /// Rows with valid gaze but for blinks, heads in one world.
    std::vector<GazeSample> rows(std::size_t count) {
        std::vector<GazeSample> rows(count);
        glm::dvec3 direction{0.0, 0.0, -1.0};
        std::size_t blink_until = 0;
        for (std::size_t i = 0; i < count; ++i) {
            if (one_in(40)) {
                direction = glm::normalize(glm::dvec3{between(-0.3, 0.3), between(-0.3, 0.3), -1});
            }
            if (i > 10 && one_in(50)) {
                blink_until = i + static_cast<std::size_t>(between(5.0, 80.0));
            }
            rows[i].sequence = i;
            rows[i].sampled = {static_cast<std::int64_t>(i) * kRow_ns, time::StampKind::Modelled};
            rows[i].head = head(rows[i].sampled.ns);
            for (EyeRay& ray : rows[i].eyes) {
                ray = {.direction = direction, .valid = i >= blink_until};
            }
        }
        return rows;
    }

    /// A world that no head comes to from the one before within a frame or a row.
    Pose other_world() {
        const glm::dvec3 axis =
            glm::normalize(glm::dvec3{between(-1.0, 1.0), between(-1.0, 1.0), between(0.1, 1.0)});
        const bool turned = one_in(2);
        const double degrees = turned ? between(30.0, 179.0) : 0.0;
        const double far_m = turned ? between(0.0, 3.0) : between(0.2, 3.0);
        return {glm::angleAxis(glm::radians(degrees), axis), far_m * axis};
    }

    bool one_in(int n) { return between(0.0, static_cast<double>(n)) < 1.0; }
    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(random_() >> 11U) * 0x1p-53;
    }

  private:
    std::mt19937_64 random_;
};

EyeView view_on(const Pose& head) {
    return {.pose = head,
            .fov = {.left_rad = -0.8, .right_rad = 0.8, .up_rad = 0.8, .down_rad = -0.8},
            .width_px = 1000,
            .height_px = 1000};
}

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

FoveaPolicy policy() {
    return {.loss = {.stale_ns = 100'000'000,
                     .hold_ns = 200'000'000,
                     .return_ns = 150'000'000,
                     .minimum_confidence = 0.6},
            .fixation_distance_m = kFixation_m};
}

std::vector<FoveaPoint> replayed(const std::vector<GazeSample>& rows) {
    GazeTrace trace;
    trace.samples = rows;
    drivers::TraceSource source(trace, 0, 12'000'000);
    GazeToFovea gaze(policy());
    std::vector<FoveaPoint> foveae;
    for (std::int64_t latch_ns = 5 * kPeriod_ns; !source.finished(); latch_ns += kPeriod_ns) {
        std::vector<GazeSample> samples;
        source.poll(latch_ns, samples);
        for (const GazeSample& sample : samples) {
            gaze.add(sample);
        }
        const Pose head = source.head_track()->at(latch_ns + kPeriod_ns);
        foveae.push_back(
            gaze.latch({latch_ns, time::StampKind::Modelled}, head, {view_on(head), view_on(head)})
                .eyes[0]);
    }
    return foveae;
}

// A head that is taken to stand still for a row at each jump is off by what it turned in it (about
// two axes, and half as much again for the spread of one about the other).
RC_GTEST_PROP(NewOrigins, MoveNoFoveaOfAReplay, (std::uint64_t seed)) {
    Person person(seed);
    const std::vector<GazeSample> rows = person.rows(400);
    std::vector<GazeSample> jumping = rows;
    Pose world;
    int jumps = 0;
    bool jumped = false;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        jumped = person.one_in(jumped ? 3 : 60);
        if (jumped) {
            world = compose(world, person.other_world());
            ++jumps;
        }
        jumping[i].head = compose(inverse(world), *rows[i].head);
    }
    const std::vector<FoveaPoint> expected = replayed(rows);
    const std::vector<FoveaPoint> foveae = replayed(jumping);
    RC_ASSERT(foveae.size() == expected.size());
    const double per_jump_deg = 2.0 * 1.5 * kTurn_deg_s * static_cast<double>(kRow_ns) * 1e-9;
    for (std::size_t i = 0; i < foveae.size(); ++i) {
        RC_ASSERT(foveae[i].state == expected[i].state);
        RC_ASSERT(foveae[i].sample_sequence == expected[i].sample_sequence);
        RC_ASSERT(angle_deg(foveae[i].direction, expected[i].direction) <=
                  jumps * per_jump_deg + 1e-6);
    }
}

/// A runtime whose origin is moved now and then.
struct Recentre {
    std::int64_t time_ns = 0;
    Pose world;  ///< from then on, in the first one
};

RC_GTEST_PROP(NewOrigins, MoveNoFoveaOfALiveRun,
              (std::uint64_t seed, bool announced, bool keeps_the_past)) {
    Person person(seed);
    const std::vector<GazeSample> rows = person.rows(400);
    std::vector<Recentre> worlds{{std::numeric_limits<std::int64_t>::min(), {}}};
    std::vector<AnnouncedOrigin> announcements;
    for (std::int64_t frame = 8; frame < 280; ++frame) {
        if (person.one_in(50)) {
            const Pose new_in_old = person.other_world();
            worlds.push_back({frame * kPeriod_ns, compose(worlds.back().world, new_in_old)});
            announcements.push_back({frame * kPeriod_ns, new_in_old});
        }
    }
    /// The head at a time, as the runtime gives it when asked during the frame of another time.
    const auto located = [&](std::int64_t time_ns, std::int64_t display_ns) {
        const std::int64_t in_force_ns = keeps_the_past ? time_ns : display_ns;
        const auto after = std::ranges::upper_bound(worlds, in_force_ns, {}, &Recentre::time_ns);
        return compose(inverse((after - 1)->world), person.head(time_ns));
    };

    GazeToFovea expected(policy());
    GazeToFovea gaze(policy());
    OriginWatch watch;
    std::size_t next_row = 0;
    std::size_t next_announcement = 0;
    int jumps = 0;
    for (std::int64_t frame = 5; frame < 290; ++frame) {
        const std::int64_t display_ns = frame * kPeriod_ns;
        const std::int64_t latch_ns = display_ns - kPeriod_ns;
        while (announced && next_announcement < announcements.size() &&
               announcements[next_announcement].time_ns < display_ns + 3 * kPeriod_ns) {
            watch.announce(announcements[next_announcement++]);
        }
        const Pose head = located(display_ns, display_ns);
        if (const auto change = watch.next(display_ns, kPeriod_ns, head)) {
            gaze.move_origin(change->new_in_old);
            jumps += change->announced ? 0 : 1;
            RC_ASSERT(change->announced == announced);
        }
        for (; next_row < rows.size() && rows[next_row].sampled.ns + 12'000'000 <= latch_ns;
             ++next_row) {
            GazeSample sample = rows[next_row];
            sample.arrived = {latch_ns, time::StampKind::Modelled};
            expected.add(sample);
            sample.head =
                watch.in_this_world(located(sample.sampled.ns, display_ns), sample.sampled.ns);
            gaze.add(sample);
        }
        const time::Stamp latch{latch_ns, time::StampKind::Modelled};
        const Pose true_head = person.head(display_ns);
        const FoveaPoint there =
            expected.latch(latch, true_head, {view_on(true_head), view_on(true_head)}).eyes[0];
        const FoveaPoint here = gaze.latch(latch, head, {view_on(head), view_on(head)}).eyes[0];
        RC_ASSERT(here.state == there.state);
        RC_ASSERT(here.sample_sequence == there.sample_sequence);
        const double per_jump_deg =
            2.0 * 1.5 * kTurn_deg_s * static_cast<double>(kPeriod_ns) * 1e-9;
        RC_ASSERT(angle_deg(here.direction, there.direction) <= jumps * per_jump_deg + 1e-6);
    }
    RC_CLASSIFY(jumps > 0);
}

}  // namespace
}  // namespace gazeloop::gaze
