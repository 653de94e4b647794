#include <fmt/core.h>

#include <array>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <functional>
#include <numbers>
#include <random>

#include "runtime/gaze/events/event_detector.h"
#include "runtime/gaze/main_sequence.h"
#include "tests/bench/bench.h"
#include "tests/support/coded/event_agreement.h"

namespace gazeloop::bench {
namespace {

constexpr const char* kBench = "events";

using Recordings = std::vector<const tests::CodedRecording*>;
using Rater = std::function<tests::Labels(const tests::CodedRecording&)>;

struct NamedRater {
    const char* name;
    Rater rater;
};

Rater coder(int number) {
    return [number](const tests::CodedRecording& recording) {
        return tests::labels_of_coder(recording, number);
    };
}

Rater plain_ivt(double threshold_deg_per_s) {
    return [threshold_deg_per_s](const tests::CodedRecording& recording) {
        return tests::velocity_threshold_labels(recording, threshold_deg_per_s);
    };
}

/// Against both coders, with the figure that saccades are to reach.
void add_agreements(std::vector<Figure>& figures, const std::string& name,
                    const Recordings& recordings, double saccade_target) {
    constexpr std::array<const char*, tests::kCoders> kCoderNames{"MN", "RA"};
    const auto add = [&](const std::string& rater, std::size_t event, double kappa,
                         std::optional<double> target) {
        if (std::isfinite(kappa)) {
            figures.push_back({kBench, name,
                               fmt::format("{}, {}", gaze::kEyeEventNames[event - 1], rater), kappa,
                               "kappa", "higher", std::nullopt, target});
        }
    };
    for (std::size_t event = 1; event <= gaze::kEyeEventNames.size(); ++event) {
        const int number = static_cast<int>(event);
        const bool saccade = number == static_cast<int>(gaze::EyeEvent::Saccade);
        add("coder-coder", event, tests::agreement(recordings, number, coder(0), coder(1)), {});
        for (int against = 0; against < tests::kCoders; ++against) {
            const char* const whom = kCoderNames[static_cast<std::size_t>(against)];
            add(fmt::format("ours-{}", whom), event,
                tests::agreement(recordings, number, tests::detected_labels, coder(against)),
                saccade ? std::optional(saccade_target) : std::nullopt);
            for (const double threshold : {45.0, 60.0}) {
                if (saccade) {
                    add(fmt::format("I-VT {:.0f}-{}", threshold, whom), event,
                        tests::agreement(recordings, number, plain_ivt(threshold), coder(against)),
                        {});
                }
            }
        }
    }
}

/// Saccades of 1 to 12 deg every .3 s, with noise, at 1000 Hz, in a loop of ten seconds.
std::vector<glm::dvec3> ten_seconds_of_gaze() {
    constexpr int kSamples = 10'000;
    std::mt19937 engine{1};
    std::normal_distribution<double> noise_rad(0.0, 0.02 * std::numbers::pi / 180.0);
    std::vector<glm::dvec3> directions;
    double deg = 0.0;
    for (int i = 0; i < kSamples;) {
        const double amplitude_deg = 1.0 + i % 12;
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

/// Of this thread, so that what else the machine does counts less.
double processor_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double seconds_for_an_hour() {
    const std::vector<glm::dvec3> directions = ten_seconds_of_gaze();
    gaze::EventDetector detector;
    constexpr std::int64_t kHour = 3'600'000;
    int saccades = 0;
    const double begin_s = processor_seconds();
    for (std::int64_t i = 0; i < kHour; ++i) {
        detector.add(i * 1'000'000, directions[static_cast<std::size_t>(i) % directions.size()]);
        saccades += detector.event() == gaze::EyeEvent::Saccade ? 1 : 0;  // the work is used
    }
    const double took_s = processor_seconds() - begin_s;
    return saccades > 0 ? took_s : std::nan("");
}

}  // namespace

std::vector<Figure> events(const Options& options) {
    std::vector<Figure> figures;
    if (options.wants("hour of 1 kHz")) {
        std::vector<double> seconds;
        for (unsigned round = 0; round < options.rounds; ++round) {
            seconds.push_back(seconds_for_an_hour());
        }
        figures.push_back(
            {kBench, "hour of 1 kHz", "detection, processor time", median(seconds), "s", "lower"});
    }
    if (!std::filesystem::exists(tests::coded_recordings_folder())) {
        fmt::print(stderr, "events: agreement is skipped: no recorded data\n");
        return figures;
    }
    const auto all = tests::read_coded_recordings(tests::coded_recordings_folder());
    constexpr std::array kTargets{0.75, 0.72, 0.78};
    for (std::size_t i = 0; i < kTargets.size(); ++i) {
        const std::string stimulus = tests::kStimuli[i];
        Recordings others;
        Recordings every;
        for (const tests::CodedRecording& recording : all) {
            if (recording.stimulus == stimulus) {
                every.push_back(&recording);
                if (!recording.chosen_on) {
                    others.push_back(&recording);
                }
            }
        }
        // Of persons on whom no parameter was chosen, and of all.
        if (options.wants(stimulus)) {
            add_agreements(figures, stimulus, others, kTargets[i]);
        }
        if (options.wants(stimulus + " all")) {
            add_agreements(figures, stimulus + " all", every, kTargets[i]);
        }
    }
    return figures;
}

}  // namespace gazeloop::bench
