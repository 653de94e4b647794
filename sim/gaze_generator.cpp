#include "sim/gaze_generator.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <optional>

#include "sim/random.h"

namespace gazeloop::sim {
namespace {

constexpr glm::dvec3 kUp{0.0, 1.0, 0.0};
constexpr glm::dvec3 kRight{1.0, 0.0, 0.0};

enum class Stream : std::uint64_t { Head = 1, Gaze, Blinks };

Random random_of(std::uint64_t seed, Stream stream) {
    return {seed, static_cast<std::uint64_t>(stream)};
}

double angle_between_rad(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Yaw and pitch as sums of slow sines.
class HeadMotion {
  public:
    explicit HeadMotion(std::uint64_t seed) {
        Random random = random_of(seed, Stream::Head);
        for (auto* sines : {&yaw_, &pitch_}) {
            for (Sine& sine : *sines) {
                sine.frequency_hz *= random.uniform(0.8, 1.2);
                sine.phase_rad = random.uniform(0.0, 2.0 * std::numbers::pi);
            }
        }
    }

    [[nodiscard]] glm::dquat at(double time_s) const {
        const double yaw = yaw_[0].at(time_s) + yaw_[1].at(time_s);
        const double pitch = pitch_[0].at(time_s) + pitch_[1].at(time_s);
        return glm::angleAxis(yaw, kUp) * glm::angleAxis(pitch, kRight);
    }

  private:
    struct Sine {
        double amplitude_deg;
        double frequency_hz;
        double phase_rad = 0.0;

        [[nodiscard]] double at(double time_s) const {
            return glm::radians(amplitude_deg) *
                   std::sin(2.0 * std::numbers::pi * frequency_hz * time_s + phase_rad);
        }
    };
    std::array<Sine, 2> yaw_{{{20.0, 0.15}, {8.0, 0.4}}};
    std::array<Sine, 2> pitch_{{{4.0, 0.2}, {1.5, 0.6}}};
};

/// A rapid turn of the gaze from one direction to another.
class Saccade {
  public:
    /// No turn at all, and in no time.
    explicit Saccade(const glm::dvec3& resting) : from_(resting), to_(resting) {}

    /// The directions differ, and are not opposite.
    Saccade(const glm::dvec3& from, const glm::dvec3& to)
        : from_(from),
          to_(to),
          axis_(glm::normalize(glm::cross(from, to))),
          amplitude_rad_(angle_between_rad(from, to)) {
        const double amplitude_deg = glm::degrees(amplitude_rad_);
        duration_s_ = (2.2 * amplitude_deg + 21.0) * 1e-3;
        const double peak_deg_per_s = 596.0 * (1.0 - std::exp(-amplitude_deg / 6.47));
        const double peak_over_mean = peak_deg_per_s * duration_s_ / amplitude_deg;
        sharpness_ = (peak_over_mean - kMinimumJerkPeak) / (kSharperPeak - kMinimumJerkPeak);
    }

    [[nodiscard]] double duration_s() const { return duration_s_; }
    [[nodiscard]] const glm::dvec3& to() const { return to_; }

    [[nodiscard]] glm::dvec3 at(double elapsed_s) const {
        if (elapsed_s >= duration_s_) {
            return to_;
        }
        return glm::angleAxis(amplitude_rad_ * progress(elapsed_s / duration_s_), axis_) * from_;
    }

  private:
    // Peak over mean velocity of the two profiles that are mixed so that both the duration and the
    // peak velocity come out right: velocities as (t (1 - t))^2, minimum jerk, and as its cube. The
    // weight of the second runs from .6 (6 deg) to -1.1 (56 deg); the peak stays in the middle down
    // to -1.3.
    static constexpr double kMinimumJerkPeak = 1.875;
    static constexpr double kSharperPeak = 2.1875;

    [[nodiscard]] double progress(double t) const {
        const double minimum_jerk = t * t * t * (10.0 + t * (-15.0 + t * 6.0));
        const double sharper = t * t * t * t * (35.0 + t * (-84.0 + t * (70.0 - t * 20.0)));
        return minimum_jerk + sharpness_ * (sharper - minimum_jerk);
    }

    glm::dvec3 from_;
    glm::dvec3 to_;
    glm::dvec3 axis_{kUp};
    double amplitude_rad_ = 0.0;
    double duration_s_ = 0.0;
    double sharpness_ = 0.0;
};

/// Where the gaze points in world: saccade, fixation, saccade, ... Times are asked in order.
class GazePath {
  public:
    GazePath(std::uint64_t seed, const HeadMotion& head)
        : head_(head),
          random_(random_of(seed, Stream::Gaze)),
          saccade_(target(0.0)) {  // the recording starts in a fixation
        plan_fixation();
    }

    [[nodiscard]] glm::dvec3 at(double time_s) {
        while (time_s >= fixation_end_s_) {
            const glm::dvec3 from = direction(fixation_end_s_);
            saccade_begin_s_ = fixation_end_s_;
            glm::dvec3 to = target(saccade_begin_s_);
            while (angle_between_rad(from, to) < kSmallestSaccade_rad) {
                to = target(saccade_begin_s_);
            }
            saccade_ = Saccade(from, to);
            plan_fixation();
        }
        return direction(time_s);
    }

  private:
    static constexpr double kSmallestSaccade_rad = glm::radians(1.0);

    [[nodiscard]] double landing_s() const { return saccade_begin_s_ + saccade_.duration_s(); }

    [[nodiscard]] glm::dvec3 direction(double time_s) const {
        const double fixated_s = time_s - landing_s();
        if (fixated_s <= 0.0) {
            return saccade_.at(time_s - saccade_begin_s_);
        }
        return glm::angleAxis(drift_rad_per_s_ * fixated_s, drift_axis_) * saccade_.to();
    }

    /// A direction in world near where the head points at that time.
    [[nodiscard]] glm::dvec3 target(double time_s) {
        constexpr double kFarthest_deg = 18.0;
        while (true) {
            const double right_rad = glm::radians(9.0 * random_.normal());
            const double up_rad = glm::radians(6.0 * random_.normal());
            if (std::hypot(right_rad, up_rad) <= glm::radians(kFarthest_deg)) {
                return head_.at(time_s) *
                       (glm::angleAxis(-right_rad, kUp) * glm::angleAxis(up_rad, kRight) *
                        glm::dvec3{0.0, 0.0, -1.0});
            }
        }
    }

    void plan_fixation() {
        constexpr double kMedian_s = 0.224;
        constexpr double kSigma = 0.45;  // of the duration's logarithm
        fixation_end_s_ = landing_s() + random_.log_normal(kMedian_s, kSigma);
        drift_rad_per_s_ = glm::radians(random_.uniform(0.2, 0.8));
        const double roll_rad = random_.uniform(0.0, 2.0 * std::numbers::pi);
        drift_axis_ = glm::angleAxis(roll_rad, saccade_.to()) *
                      glm::normalize(glm::cross(saccade_.to(), kUp));
    }

    const HeadMotion& head_;
    Random random_;
    Saccade saccade_;
    double saccade_begin_s_ = 0.0;
    double fixation_end_s_ = 0.0;
    double drift_rad_per_s_ = 0.0;
    glm::dvec3 drift_axis_{kUp};
};

/// Times are asked in order.
class Blinks {
  public:
    explicit Blinks(std::uint64_t seed) : random_(random_of(seed, Stream::Blinks)) { plan(); }

    /// How far the blink of that time has come, 0 .. 1; none while the eyes are open.
    [[nodiscard]] std::optional<double> at(double time_s) {
        while (time_s >= begin_s_ + duration_s_) {
            plan();
        }
        if (time_s < begin_s_) {
            return std::nullopt;
        }
        return (time_s - begin_s_) / duration_s_;
    }

  private:
    void plan() {
        // 15 a minute: one per 4 s, of which a blink takes .25 s and the shortest pause .5 s.
        begin_s_ += duration_s_ + 0.5 + random_.exponential(3.25);
        duration_s_ = random_.uniform(0.1, 0.4);
    }

    Random random_;
    double begin_s_ = 0.0;
    double duration_s_ = 0.0;
};

}  // namespace

drivers::Trace generate_gaze(const GazeGeneratorConfig& config) {
    constexpr gaze::PerEye<double> kEyeX_m{-0.0315, 0.0315};
    const HeadMotion head(config.seed);
    GazePath gaze(config.seed, head);
    Blinks blinks(config.seed);

    drivers::Trace trace;
    trace.file = "generated";
    trace.format = "gazeloop";
    trace.device = fmt::format("gaze generator, seed {}", config.seed);
    const auto count =
        static_cast<std::uint64_t>(std::max(1.0, std::floor(config.seconds * config.rate_hz)));
    trace.samples.reserve(count);
    for (std::uint64_t i = 0; i < count; ++i) {
        const double time_s = static_cast<double>(i) / config.rate_hz;
        const glm::dquat head_orientation = head.at(time_s);
        const glm::dvec3 looked_at_m =
            glm::conjugate(head_orientation) * gaze.at(time_s) * config.distance_m;
        const std::optional<double> blink = blinks.at(time_s);

        gaze::GazeSample sample;
        sample.sequence = i;
        sample.device_ns = std::llround(time_s * 1e9);
        sample.sampled = {sample.device_ns, latency::StampKind::Modelled};
        sample.head = gaze::Pose{head_orientation, glm::dvec3{0.0}};
        for (const gaze::Eye eye : gaze::kEyes) {
            gaze::EyeRay& ray = sample.eyes[gaze::index(eye)];
            ray.origin_m = {kEyeX_m[gaze::index(eye)], 0.0, 0.0};
            ray.valid = !blink;
            ray.openness = blink ? std::abs(2.0 * *blink - 1.0) : 1.0;
            ray.confidence = blink ? 0.0 : 1.0;
            if (!blink) {
                ray.direction = glm::normalize(looked_at_m - ray.origin_m);
            }
        }
        trace.samples.push_back(sample);
    }
    return trace;
}

}  // namespace gazeloop::sim
