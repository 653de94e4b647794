#include "runtime/gaze/events/saccade_forecast.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "runtime/gaze/main_sequence.h"

namespace gazeloop::gaze {
namespace {

// Chosen on the same half of the persons as EventDetector's.
constexpr double kUsual_deg = 3.5;  // amplitudes before anything is seen: their median,
constexpr double kUsualSd = 1.23;   // and SD of their logarithm
constexpr double kVigour = 1.2;     // real saccades peak early; and in steps of one SD:
constexpr std::array kVigours{0.7788 * kVigour, kVigour, 1.2840 * kVigour};
constexpr std::array kVigourEvidence{0.5, 0.0, 0.5};  // half the square of the step
constexpr double kNoticed_s = 0.0052;                 // a saccade is noticed so late
constexpr double kSpeedSd = 0.15;                     // of the speed, and at rest:
constexpr double kPeakSd = 0.54;
constexpr double kRestingSd_deg_per_s = 7.4;
constexpr double kElapsedSd = 0.16;
constexpr double kLeastElapsedSd_s = 0.0047;
constexpr double kIgnored = 18.0;  // exp(-18) is nothing beside 1

constexpr double kSmallest_deg = 0.4;
constexpr double kLargest_deg = 30.0;
constexpr std::size_t kSteps = 128;

/// The course of one amplitude in equal steps of its duration.
struct Course {
    double amplitude_deg = 0.0;
    double duration_s = 0.0;
    double unlikely = 0.0;  ///< half the square of its distance from what is usual, in SDs
    std::array<double, kSteps + 1> progress{};

    /// 0 .. 1 at a share of the duration, of any size.
    [[nodiscard]] double at(double share) const {
        const double step = std::clamp(share, 0.0, 1.0) * kSteps;
        const auto before = std::min(static_cast<std::size_t>(step), kSteps - 1);
        return std::lerp(progress[before], progress[before + 1],
                         step - static_cast<double>(before));
    }
    /// Progress per duration.
    [[nodiscard]] double slope(double share) const {
        const auto before = static_cast<std::size_t>(std::clamp(share, 0.0, 0.999) * kSteps);
        return (progress[before + 1] - progress[before]) * kSteps;
    }
    /// The share of the duration at which so much is done, 0 .. 1.
    [[nodiscard]] double when(double done) const {
        const auto after = std::ranges::lower_bound(progress, done);
        if (after == progress.begin()) {
            return 0.0;
        }
        if (after == progress.end()) {
            return 1.0;
        }
        const double before = *(after - 1);
        return (static_cast<double>(after - progress.begin() - 1) +
                (done - before) / (*after - before)) /
               kSteps;
    }
};

template <std::size_t Count>
std::array<Course, Count> make_courses() {
    std::array<Course, Count> courses;
    for (std::size_t i = 0; i < Count; ++i) {
        Course& course = courses[i];
        course.amplitude_deg = kSmallest_deg * std::pow(kLargest_deg / kSmallest_deg,
                                                        static_cast<double>(i) / (Count - 1));
        const SaccadeCourse real(course.amplitude_deg, 1.0);
        course.duration_s = real.duration_s();
        const double off = std::log(course.amplitude_deg / kUsual_deg) / kUsualSd;
        course.unlikely = 0.5 * off * off;
        for (std::size_t step = 0; step <= kSteps; ++step) {
            course.progress[step] =
                real.progress(real.duration_s() * static_cast<double>(step) / kSteps);
        }
    }
    return courses;
}

template <std::size_t Count>
const std::array<Course, Count>& all_courses() {
    static const std::array<Course, Count> kCourses = make_courses<Count>();
    return kCourses;
}

double half_square(double x) { return 0.5 * x * x; }

}  // namespace

SaccadeForecast::SaccadeForecast(const SaccadeInFlight& seen) : travelled_deg_(seen.travelled_deg) {
    static_assert(kVigours.size() == kVigourCount);
    const std::array<Course, kAmplitudes>& courses = all_courses<kAmplitudes>();
    for (std::size_t c = 0; c < kAmplitudes; ++c) {
        const Course& course = courses[c];
        if (course.amplitude_deg < seen.travelled_deg) {
            continue;
        }
        const double now = course.when(seen.travelled_deg / course.amplitude_deg);
        for (std::size_t i = 0; i < kVigours.size(); ++i) {
            const double duration_s = course.duration_s / (seen.vigour * kVigours[i]);
            const double mean_speed = course.amplitude_deg / duration_s;
            const double then = std::max(0.0, now - seen.speed_age_s / duration_s);
            const double speed = mean_speed * course.slope(then);
            const double by_speed = course.unlikely + kVigourEvidence[i] +
                                    half_square((seen.speed_deg_per_s - speed) /
                                                (kSpeedSd * speed + kRestingSd_deg_per_s));
            if (!(by_speed < kIgnored)) {
                continue;  // what follows only adds to it
            }
            const double peak = mean_speed * course.slope(std::min(then, 0.5));
            const double elapsed_s = now * duration_s;
            const double unlikely = by_speed +
                                    half_square((seen.peak_deg_per_s - peak) /
                                                (kPeakSd * peak + kRestingSd_deg_per_s)) +
                                    half_square((seen.elapsed_s + kNoticed_s - elapsed_s) /
                                                (kElapsedSd * elapsed_s + kLeastElapsedSd_s));
            if (!(unlikely < kIgnored)) {
                continue;
            }
            const double weight = std::exp(-unlikely);
            explanations_[count_++] = {c, weight, now, duration_s};
            weights_ += weight;
        }
    }
}

SaccadeTravel SaccadeForecast::after(double ahead_s) const {
    if (weights_ == 0.0) {
        return {};
    }
    const std::array<Course, kAmplitudes>& courses = all_courses<kAmplitudes>();
    double mean = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < count_; ++i) {
        const Explanation& by = explanations_[i];
        const Course& course = courses[by.course];
        const double further_deg =
            course.amplitude_deg * course.at(by.done + ahead_s / by.duration_s) - travelled_deg_;
        mean += by.weight * further_deg;
        squares += by.weight * further_deg * further_deg;
    }
    mean /= weights_;
    return {.further_deg = std::max(mean, 0.0),
            .sd_deg = std::sqrt(std::max(squares / weights_ - mean * mean, 0.0))};
}

SaccadeLanding SaccadeForecast::landing() const {
    if (weights_ == 0.0) {
        return {};
    }
    double mean = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < count_; ++i) {
        const Explanation& by = explanations_[i];
        const double left_s = (1.0 - by.done) * by.duration_s;
        mean += by.weight * left_s;
        squares += by.weight * left_s * left_s;
    }
    mean /= weights_;
    return {.in_s = mean, .sd_s = std::sqrt(std::max(squares / weights_ - mean * mean, 0.0))};
}

}  // namespace gazeloop::gaze
