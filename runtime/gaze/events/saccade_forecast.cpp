#include "runtime/gaze/events/saccade_forecast.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "runtime/gaze/main_sequence.h"

namespace gazeloop::gaze {
namespace {

// Chosen on the same persons as GazePredictor's.
constexpr double kUsual_deg = 3.94;    // amplitudes before anything is seen: their median,
constexpr double kUsualSd = 1.60;      // and SD of their logarithm
constexpr double kVigour = 1.23;       // in steps of one SD:
constexpr double kVigourSd = 0.41;     // of its logarithm
constexpr double kNoticed_s = 0.0100;  // a saccade is noticed so late
constexpr double kSpeedSd = 0.25;      // of the speed, and at rest:
constexpr double kPeakSd = 0.15;
constexpr double kRestingSd_deg_per_s = 23.2;
constexpr double kNoise = 0.24;  // of what a resting gaze shows, on top of that
constexpr double kStepSd = 0.26;
constexpr double kStepNoise = 3.2;
constexpr double kLeastStepSd_deg_per_s = 29.0;
constexpr double kElapsedSd = 0.17;
constexpr double kLeastElapsedSd_s = 0.0059;
// How much large saccades lean to an early peak, and from what amplitude on.
constexpr double kLean = 0.32;
constexpr double kLeaning_deg = 6.0;
// Of the loss that a forecast is to make least, so much is the error's fourth power, the rest its
// square.
constexpr double kFourthPower = 0.48;
constexpr int kCentreSteps = 3;  // towards the least: near enough
constexpr double kCentreStep = 0.7;
constexpr double kCertain_deg = 1e-3;
// What share of the forecasts may go less far than at_least_deg, near and far ahead (by_horizon).
constexpr double kLess = 0.23;
constexpr double kLessFar = 0.02;
constexpr double kIgnored = 18.0;  // exp(-18) is nothing beside 1
constexpr double kIgnoredBySpeed = 12.0;
constexpr double kUnlikely = 5e-4;  // of all weights: such explanations are left out

constexpr double kSmallest_deg = 0.4;
constexpr double kLargest_deg = 45.0;
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
    /// Progress per duration; 0 before it begins.
    [[nodiscard]] double slope(double share) const {
        if (share < 0.0) {
            return 0.0;
        }
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
        const double lean = kLean * -std::expm1(-course.amplitude_deg / kLeaning_deg);
        const SaccadeCourse real(course.amplitude_deg, 1.0, lean);
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

double by_horizon(double ahead_s, double near, double far) {
    constexpr double kNear_s = 0.020;
    return std::lerp(near, far, std::clamp((ahead_s - kNear_s) / kNear_s, 0.0, 1.0));
}

SaccadeForecast::SaccadeForecast(const SaccadeInFlight& seen) : travelled_deg_(seen.travelled_deg) {
    const std::array<Course, kAmplitudes>& courses = all_courses<kAmplitudes>();
    static const std::array<double, kVigourCount> kVigours{kVigour * std::exp(-kVigourSd), kVigour,
                                                           kVigour * std::exp(kVigourSd)};
    constexpr double kLatestPeak = 0.5 - 0.25 * kLean;
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
            const double by_speed = course.unlikely + (i == 1 ? 0.0 : 0.5) +
                                    half_square((seen.speed_deg_per_s - speed) /
                                                (kSpeedSd * speed + kRestingSd_deg_per_s +
                                                 kNoise * seen.noise_deg_per_s));
            if (!(by_speed < kIgnoredBySpeed)) {
                continue;  // what follows only adds to it
            }
            const double peak = mean_speed * course.slope(std::min(then, kLatestPeak));
            const double step = mean_speed * course.slope(now - seen.step_age_s / duration_s);
            const double elapsed_s = now * duration_s;
            const double unlikely = by_speed +
                                    half_square((seen.peak_deg_per_s - peak) /
                                                (kPeakSd * peak + kRestingSd_deg_per_s)) +
                                    half_square((seen.step_deg_per_s - step) /
                                                (kStepSd * speed + kLeastStepSd_deg_per_s +
                                                 kStepNoise * seen.noise_deg_per_s)) +
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
    leave_out_unlikely();
}

void SaccadeForecast::leave_out_unlikely() {
    const double least = kUnlikely * weights_;
    const auto begin = explanations_.begin();
    const auto end = std::remove_if(begin, begin + static_cast<std::ptrdiff_t>(count_),
                                    [=](const Explanation& by) { return by.weight < least; });
    count_ = static_cast<std::size_t>(end - begin);
    weights_ = 0.0;
    for (std::size_t i = 0; i < count_; ++i) {
        weights_ += explanations_[i].weight;
    }
}

SaccadeTravel SaccadeForecast::after(double ahead_s) const {
    if (weights_ == 0.0) {
        return {};
    }
    struct Weighed {
        double further_deg;
        double weight;
    };
    const std::array<Course, kAmplitudes>& courses = all_courses<kAmplitudes>();
    std::array<Weighed, kAmplitudes * kVigourCount> all;
    double mean = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < count_; ++i) {
        const Explanation& by = explanations_[i];
        const Course& course = courses[by.course];
        const double further_deg =
            course.amplitude_deg * course.at(by.done + ahead_s / by.duration_s) - travelled_deg_;
        all[i] = {further_deg, by.weight};
        mean += by.weight * further_deg;
        squares += by.weight * further_deg * further_deg;
    }
    mean /= weights_;
    SaccadeTravel travel{.further_deg = mean,
                         .sd_deg = std::sqrt(std::max(squares / weights_ - mean * mean, 0.0))};
    if (travel.sd_deg > kCertain_deg) {
        for (int step = 0; step < kCentreSteps; ++step) {
            double sum = 0.0;
            double weights = 0.0;
            for (std::size_t i = 0; i < count_; ++i) {
                const double off = (all[i].further_deg - travel.further_deg) / travel.sd_deg;
                const double weight =
                    all[i].weight * (1.0 - kFourthPower + kFourthPower * off * off);
                sum += weight * all[i].further_deg;
                weights += weight;
            }
            travel.further_deg += kCentreStep * (sum / weights - travel.further_deg);
        }
    }
    travel.further_deg = std::max(travel.further_deg, 0.0);
    const auto end = all.begin() + static_cast<std::ptrdiff_t>(count_);
    std::sort(all.begin(), end, [](const Weighed& one, const Weighed& other) {
        return one.further_deg < other.further_deg;
    });
    const double share = by_horizon(ahead_s, kLess, kLessFar);
    double less = 0.0;
    for (auto one = all.begin(); one != end; ++one) {
        less += one->weight;
        if (less >= share * weights_) {
            travel.at_least_deg = std::max(one->further_deg, 0.0);
            break;
        }
    }
    return travel;
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
