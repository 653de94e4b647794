#include "drivers/steam_frame/gaze_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "runtime/gaze/direction.h"
#include "runtime/gaze/direction_covariance.h"

namespace gazeloop::drivers::steam_frame {
namespace {

/// Above an SD of one radian it says nothing of a direction.
constexpr double kGreatestVariance = 1.0;

enum class Stated : std::uint8_t { Value, Nothing, Nonsense };

Stated judge_direction(const glm::dvec3& direction) {
    if (!gaze::is_finite(direction) || direction == glm::dvec3{0.0}) {
        return Stated::Nothing;
    }
    constexpr double kOfUnit = 0.1;  // floats, perhaps of a mean of directions
    return std::abs(glm::length(direction) - 1.0) <= kOfUnit ? Stated::Value : Stated::Nonsense;
}

Stated judge_variances(const glm::dvec3& variances) {
    if (variances == glm::dvec3{0.0}) {
        return Stated::Nothing;
    }
    const auto can_be = [](double v) { return v >= 0.0 && v <= kGreatestVariance; };
    return can_be(variances.x) && can_be(variances.y) && can_be(variances.z) ? Stated::Value
                                                                             : Stated::Nonsense;
}

}  // namespace

gaze::GazeSample GazeSamples::take(const GazeRecord& record, std::uint32_t counter,
                                   std::int64_t arrived_ns, const ClockPair& pair) {
    gaze::GazeSample sample;
    sample.processing =
        rays_ == Rays::Filtered ? gaze::GazeProcessing::Filtered : gaze::GazeProcessing::Raw;
    const bool eyes_can_be = set_eyes(record, sample);
    const bool time_can_be = set_times(record.time_s, arrived_ns, pair, sample);
    if (counts_.samples > 0) {
        follow_period(counter, record.time_s);
    }
    count_lost(counter, arrived_ns);
    last_time_s_ = record.time_s;
    ++counts_.reports;
    ++counts_.samples;
    if (!eyes_can_be || !time_can_be) {
        ++counts_.damaged;
        if (!std::exchange(told_damaged_, true)) {
            notices_.push_back(fmt::format(
                "a record holds {} that cannot be one: it is left out, and such records are "
                "counted",
                time_can_be ? "a direction or a variance" : "a time"));
        }
    }
    return sample;
}

bool GazeSamples::set_eyes(const GazeRecord& record, gaze::GazeSample& sample) {
    bool can_be = true;
    const auto& rays = rays_ == Rays::Filtered ? record.filtered : record.before_fusion;
    for (const gaze::Eye eye : gaze::kEyes) {
        const auto& [direction, variances] = rays[gaze::index(eye)];
        gaze::EyeRay& ray = sample.eyes[gaze::index(eye)];
        const double openness = record.openness[gaze::index(eye)];
        if (std::isfinite(openness)) {
            ray.openness = std::clamp(openness, 0.0, 1.0);
        }
        const Stated stated = judge_direction(direction);
        can_be = can_be && stated != Stated::Nonsense;
        if (stated != Stated::Value) {
            continue;
        }
        ray.direction = glm::normalize(direction);
        ray.valid = true;
        const Stated stated_variances = judge_variances(variances);
        can_be = can_be && stated_variances != Stated::Nonsense;
        if (stated_variances == Stated::Value) {
            ray.covariance = gaze::turning_part(ray.direction, variances);
        }
    }
    return can_be;
}

bool GazeSamples::set_times(double time_s, std::int64_t arrived_ns, const ClockPair& pair,
                            gaze::GazeSample& sample) {
    constexpr double kLongest_s = 9e9;  // 2^63 ns are a little more
    if (!(time_s >= 0.0 && time_s < kLongest_s)) {
        sample.arrived = {arrived_ns, time::StampKind::Measured};
        return false;
    }
    const std::int64_t raw_ns = std::llround(time_s * 1e9);
    clock_.stamp(static_cast<std::uint64_t>(raw_ns), arrived_ns, sample);
    const CarriedTime stated = carried(raw_ns, pair);
    const std::int64_t age_ns = time::between({stated.ns, time::StampKind::Measured},
                                              {arrived_ns, time::StampKind::Measured})
                                    .ns;
    const bool possible = age_ns >= -stated.uncertainty_ns && age_ns <= kGreatestAge_ns;
    judge_age(possible, age_ns);
    if (times_as_stated_) {
        sample.ready = {};
        sample.sampled = {};
        sample.uncertainty_ns.reset();
        if (possible) {
            sample.sampled = {stated.ns, time::StampKind::Measured};
            sample.uncertainty_ns = stated.uncertainty_ns;
        }
    }
    return possible || !times_as_stated_;
}

void GazeSamples::judge_age(bool possible, std::int64_t age_ns) {
    against_verdict_ = possible != times_as_stated_ ? against_verdict_ + 1 : 0;
    if (against_verdict_ < (times_as_stated_ ? kOddAges : kGoodAges)) {
        return;
    }
    against_verdict_ = 0;
    times_as_stated_ = !times_as_stated_;
    notices_.push_back(
        times_as_stated_
            ? "times: of CLOCK_MONOTONIC_RAW again"
            : fmt::format("times: NOT of CLOCK_MONOTONIC_RAW as published, by that a sample is "
                          "{:.3f} s old. The age of the gaze comes of a clock fit and the "
                          "tracker profile's delay instead. Please report it",
                          static_cast<double>(age_ns) * 1e-9));
}

void GazeSamples::count_lost(std::uint32_t counter, std::int64_t arrived_ns) {
    const std::uint32_t missing = counter - last_counter_ - 1;  // modulo 2^32
    constexpr std::uint32_t kMostInAPause = 1000;
    constexpr std::int64_t kPause_ns = 1'000'000'000;
    const bool flowing = counts_.samples > 0 && arrived_ns - last_arrived_ns_ < kPause_ns;
    lost_before_last_ = flowing && missing < kMostInAPause ? missing : 0;
    counts_.lost += lost_before_last_;
    if (flowing && missing >= kMostInAPause) {
        notices_.emplace_back("its counter began anew");
    }
    last_counter_ = counter;
    last_arrived_ns_ = arrived_ns;
}

void GazeSamples::follow_period(std::uint32_t counter, double time_s) {
    // By the counter, because whoever looks as seldom as the samples that it has found would never
    // find more.
    const std::uint32_t records = counter - last_counter_;  // modulo 2^32
    const double step_ns = (time_s - last_time_s_) * 1e9 / static_cast<double>(records);
    constexpr double kLongest_ns = 250e6;  // longer is a pause
    if (records > 0 && step_ns > 0.0 && step_ns < kLongest_ns) {
        constexpr double kShare = 0.125;
        period_ns_ += (period_ns_ > 0.0 ? kShare : 1.0) * (step_ns - period_ns_);
    }
}

std::optional<std::string> GazeSamples::take_change() {
    if (!notices_.empty()) {
        std::string line = std::move(notices_.front());
        notices_.pop_front();
        return line;
    }
    // What the fit is worth matters only while times rest on it.
    return times_as_stated_ ? std::nullopt : clock_.take_change();
}

}  // namespace gazeloop::drivers::steam_frame
