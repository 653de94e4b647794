#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <tuple>

#include "drivers/trace/read_trace.h"
#include "runtime/gaze/events/gaze_predictor.h"
#include "runtime/gaze/loss_machine.h"
#include "tests/bench/bench.h"
#include "tests/bench/headset_prediction.h"
#include "tests/bench/hour_of_gaze.h"
#include "tests/bench/numpy_ivt.h"
#include "tests/support/coded/prediction_errors.h"

namespace gazeloop::bench {
namespace {

constexpr const char* kBench = "prediction";
constexpr const char* kHeadset = "headset";

using tests::Predictor;
using tests::TargetClass;

/// A saccade 20 ms ahead: what its 95th percentile is to be at most, over that of holding.
constexpr std::size_t kJudgedHorizon = 2;
constexpr double kSaccadeTarget = 0.75;
constexpr double kWorstSaccadeTarget = 0.85;

void add_class(std::vector<Figure>& figures, const std::string& whose,
               const std::map<std::string, tests::PersonErrors>& errors, std::size_t target) {
    for (std::size_t h = 0; h < tests::kHorizons_ms.size(); ++h) {
        const std::string what = fmt::format("{}, {} ms", whose, tests::kHorizons_ms[h]);
        const auto add = [&](const std::string& metric, double value, const char* unit,
                             std::optional<double> goal) {
            figures.push_back({kBench, tests::kTargetClassNames[target],
                               fmt::format("{}: {}", what, metric), value, unit, "lower",
                               std::nullopt, goal});
        };
        std::vector<double> median_held;
        std::vector<double> p95_held;
        for (const auto& [person, of_person] : errors) {
            const std::vector<double>& held = of_person[target][h].front();
            if (held.size() >= tests::kFewestErrors) {
                median_held.push_back(tests::percentile(held, 50.0));
                p95_held.push_back(tests::percentile(held, 95.0));
            }
        }
        if (p95_held.empty()) {
            continue;
        }
        add("persons", static_cast<double>(p95_held.size()), "", {});
        add("hold P50", median(median_held), "deg", {});
        add("hold P95", median(p95_held), "deg", {});
        for (const Predictor predictor : {Predictor::Linear, Predictor::OneEuro, Predictor::Ours}) {
            const char* const name = tests::kPredictorNames[static_cast<std::size_t>(predictor)];
            const std::vector<double> ratios =
                tests::ratios_to_hold(errors, static_cast<TargetClass>(target), h, predictor);
            const bool ours = predictor == Predictor::Ours;
            const bool judged = ours && static_cast<TargetClass>(target) == TargetClass::Saccade &&
                                h == kJudgedHorizon;
            add(fmt::format("{} P95 over hold", name), median(ratios), "x",
                judged ? std::optional(kSaccadeTarget) : std::nullopt);
            add(fmt::format("{} worst person", name), *std::ranges::max_element(ratios), "x",
                judged ? std::optional(kWorstSaccadeTarget)
                : ours ? std::optional(1.0)
                       : std::nullopt);
        }
    }
}

/// Of traces recorded in a headset with the head's poses; two persons.
void add_headset(std::vector<Figure>& figures) {
    const auto folder = tests::coded_recordings_folder().parent_path() / "htc_vive_pro";
    if (!std::filesystem::exists(folder)) {
        fmt::print(stderr, "prediction: {} is skipped: no recorded data\n", kHeadset);
        return;
    }
    std::vector<gaze::GazeTrace> traces;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        traces.push_back(value_or_throw(drivers::read_trace(entry.path().string())));
    }
    for (const std::int64_t ahead_ms : {20, 40}) {
        std::array<HeadsetErrors, gaze::kEyeEventNames.size()> all;
        for (const gaze::GazeTrace& trace : traces) {
            const auto errors = headset_errors(trace, ahead_ms * 1'000'000);
            for (std::size_t event = 0; event < all.size(); ++event) {
                const auto append = [](std::vector<double>& to, const std::vector<double>& from) {
                    to.insert(to.end(), from.begin(), from.end());
                };
                append(all[event].held_in_head, errors[event].held_in_head);
                append(all[event].held_in_world, errors[event].held_in_world);
                append(all[event].predicted, errors[event].predicted);
            }
        }
        for (std::size_t event = 0; event + 1 < all.size(); ++event) {
            const auto add = [&](const char* how, const std::vector<double>& errors) {
                for (const double percent : {50.0, 95.0}) {
                    figures.push_back(
                        {kBench, kHeadset,
                         fmt::format("{}, {} ms: {} P{:.0f}", gaze::kEyeEventNames[event], ahead_ms,
                                     how, percent),
                         tests::percentile(errors, percent), "deg", "lower"});
                }
            };
            if (all[event].predicted.size() >= tests::kFewestErrors) {
                add("held in head", all[event].held_in_head);
                add("held in world", all[event].held_in_world);
                add("predicted", all[event].predicted);
            }
        }
    }
}

/// Detection, a prediction per sample, and whether there is gaze; every four seconds a blink.
double seconds_of_prediction_and_loss() {
    constexpr std::int64_t kAhead_ns = 20'000'000;
    constexpr std::int64_t kBlinkEvery_ns = 4'000'000'000;
    constexpr std::int64_t kBlink_ns = 150'000'000;
    gaze::LossMachine loss({});
    gaze::GazePredictor predictor;
    gaze::GazeSample sample;
    int extrapolated = 0;
    int held = 0;
    const double seconds = seconds_for_an_hour([&](std::int64_t time_ns, const glm::dvec3& gaze) {
        sample.sampled = {time_ns, time::StampKind::Modelled};
        sample.arrived = sample.sampled;
        for (gaze::EyeRay& ray : sample.eyes) {
            ray.direction = gaze;
            ray.valid = time_ns % kBlinkEvery_ns >= kBlink_ns;
        }
        const std::optional<gaze::JudgedSample> judged = loss.add(sample);
        predictor.add(time_ns, judged && judged->usable ? judged->directions[0] : std::nullopt);
        const gaze::GazePrediction prediction = predictor.predict(time_ns + kAhead_ns);
        extrapolated += prediction.verdict == gaze::PredictionVerdict::Extrapolated ? 1 : 0;
        held += loss.condition(time_ns).state == gaze::FoveaState::Held ? 1 : 0;
    });
    return extrapolated > 0 && held > 0 ? seconds : std::nan("");
}

/// What an hour takes, and how that compares with I-VT in numpy on the same gaze.
void add_hour(const Options& options, std::vector<Figure>& figures) {
    constexpr double kHour_samples = 3.6e6;
    constexpr double kIvtSeconds = 300.0;
    constexpr double kCheaperThanNumpy = 20.0;
    std::vector<double> all_s;
    std::vector<double> detection_s;
    std::vector<double> whole_ns;
    std::vector<double> online_ns;
    for (unsigned round = 0; round < options.rounds; ++round) {
        all_s.push_back(seconds_of_prediction_and_loss());
        detection_s.push_back(seconds_of_detection_alone());
        if (round == 0 || !whole_ns.empty()) {
            if (const auto ivt = numpy_ivt(ten_seconds_of_gaze(), kIvtSeconds)) {
                whole_ns.push_back(ivt->whole_ns);
                online_ns.push_back(ivt->online_ns);
            }
        }
    }
    figures.push_back({kBench, kHourOfGaze, "detection, prediction and loss", median(all_s), "s",
                       "lower", std::nullopt, 2.0});
    figures.push_back({kBench, kHourOfGaze, "detection alone", median(detection_s), "s", "lower"});
    if (whole_ns.empty()) {
        return;
    }
    for (const auto& [what, ns, target] :
         {std::tuple{"I-VT in numpy, sample by sample", median(online_ns),
                     std::optional(kCheaperThanNumpy)},
          std::tuple{"I-VT in numpy, whole recording", median(whole_ns),
                     std::optional<double>{}}}) {
        figures.push_back({kBench, kHourOfGaze, fmt::format("{} over all of ours", what),
                           ns * kHour_samples * 1e-9 / median(all_s), "x", "higher", std::nullopt,
                           target});
        figures.push_back({kBench, kHourOfGaze, fmt::format("{} over detection", what),
                           ns * kHour_samples * 1e-9 / median(detection_s), "x"});
    }
}

}  // namespace

std::vector<Figure> prediction(const Options& options) {
    std::vector<Figure> figures;
    if (options.wants(kHourOfGaze)) {
        add_hour(options, figures);
    }
    if (options.wants(kHeadset)) {
        add_headset(figures);
    }
    if (!std::filesystem::exists(tests::coded_recordings_folder())) {
        fmt::print(stderr, "prediction: skipped: no recorded data\n");
        return figures;
    }
    const auto all = tests::read_coded_recordings(tests::coded_recordings_folder());
    for (const bool chosen_on : {false, true}) {
        std::vector<const tests::CodedRecording*> half;
        for (const tests::CodedRecording& recording : all) {
            if (recording.chosen_on == chosen_on) {
                half.push_back(&recording);
            }
        }
        const auto errors = tests::prediction_errors(half);
        for (std::size_t target = 0; target < tests::kTargetClassNames.size(); ++target) {
            if (options.wants(tests::kTargetClassNames[target])) {
                add_class(figures, chosen_on ? "chosen on" : "others", errors, target);
            }
        }
    }
    return figures;
}

}  // namespace gazeloop::bench
