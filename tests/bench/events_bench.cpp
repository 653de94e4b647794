#include <fmt/core.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <functional>

#include "runtime/gaze/events/event_detector.h"
#include "tests/bench/bench.h"
#include "tests/bench/hour_of_gaze.h"
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

}  // namespace

std::vector<Figure> events(const Options& options) {
    std::vector<Figure> figures;
    if (options.wants(kHourOfGaze)) {
        std::vector<double> seconds;
        for (unsigned round = 0; round < options.rounds; ++round) {
            seconds.push_back(seconds_of_detection_alone());
        }
        figures.push_back(
            {kBench, kHourOfGaze, "detection, processor time", median(seconds), "s", "lower"});
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
