#include "tests/bench/hour_of_gaze.h"

#include <cmath>
#include <ctime>
#include <numbers>
#include <random>

#include "runtime/gaze/events/event_detector.h"
#include "runtime/gaze/main_sequence.h"

namespace gazeloop::bench {

std::vector<glm::dvec3> ten_seconds_of_gaze() {
    constexpr int kSamples = 10'000;
    std::mt19937 engine{1};
    std::normal_distribution<double> noise_rad(0.0, 0.02 * std::numbers::pi / 180.0);
    std::vector<glm::dvec3> directions;
    double deg = 0.0;
    for (int i = 0; i < kSamples;) {
        const double amplitude_deg = 1.0 + i / 300 % 12;
        const gaze::SaccadeCourse course(amplitude_deg, 1.0);
        const double to_deg = deg > 0.0 ? -amplitude_deg : amplitude_deg;
        for (int in = 0; in < 300 && i < kSamples; ++in, ++i) {
            const double done = course.progress(in * 1e-3);
            const double right_rad =
                (deg + done * to_deg) * std::numbers::pi / 180.0 + noise_rad(engine);
            directions.emplace_back(std::sin(right_rad), noise_rad(engine), -std::cos(right_rad));
        }
        deg += to_deg;
    }
    return directions;
}

double processor_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double seconds_of_detection_alone() {
    gaze::EventDetector detector;
    int saccades = 0;
    const double seconds = seconds_for_an_hour([&](std::int64_t time_ns, const glm::dvec3& gaze) {
        detector.add(time_ns, gaze);
        saccades += detector.event() == gaze::EyeEvent::Saccade ? 1 : 0;  // the work is used
    });
    return saccades > 0 ? seconds : std::nan("");
}

}  // namespace gazeloop::bench
