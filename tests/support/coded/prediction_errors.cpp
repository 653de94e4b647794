#include "tests/support/coded/prediction_errors.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <optional>

#include "runtime/gaze/direction.h"
#include "runtime/gaze/events/gaze_predictor.h"
#include "runtime/gaze/filter/one_euro_filter.h"

namespace gazeloop::tests {
namespace {

constexpr int kCodedFixation = 1;
constexpr int kCodedSaccade = 2;
constexpr int kCodedOscillation = 3;
constexpr int kCodedPursuit = 4;
constexpr int kCodedBlink = 5;
constexpr std::int64_t kGoingOn_ns = 4'000'000;

bool is_saccade(const CodedSample& sample) {
    return sample.first_coder == kCodedSaccade || sample.second_coder == kCodedSaccade;
}

bool is_blink(const CodedSample& sample) {
    return !sample.direction || sample.first_coder == kCodedBlink ||
           sample.second_coder == kCodedBlink;
}

/// Of a prediction made at one sample for a later one.
std::optional<TargetClass> class_of(const std::vector<CodedSample>& samples, std::size_t from,
                                    std::size_t to) {
    const auto begin = samples.begin();
    const auto at = [&](std::size_t i) { return begin + static_cast<std::ptrdiff_t>(i); };
    if (samples[to].first_coder != samples[to].second_coder ||
        std::any_of(at(from), at(to + 1), is_blink)) {
        return std::nullopt;
    }
    switch (samples[to].first_coder) {
        case kCodedFixation:
            return TargetClass::Fixation;
        case kCodedOscillation:
            return TargetClass::Oscillation;
        case kCodedPursuit:
            return TargetClass::Pursuit;
        case kCodedSaccade:
            break;
        default:
            return std::nullopt;
    }
    std::size_t since = from;
    while (since > 0 && samples[from].time_ns - samples[since].time_ns < kGoingOn_ns) {
        --since;
    }
    return std::all_of(at(since), at(to + 1), is_saccade) ? TargetClass::Saccade
                                                          : TargetClass::Onset;
}

/// The sample at that time or the next one after; none where the recording ends before.
std::optional<std::size_t> at_time(const std::vector<CodedSample>& samples, std::size_t from,
                                   std::int64_t time_ns) {
    while (from < samples.size() && samples[from].time_ns < time_ns) {
        ++from;
    }
    return from < samples.size() ? std::optional(from) : std::nullopt;
}

void add_errors(const CodedRecording& recording, PersonErrors& errors) {
    gaze::GazePredictor predictor;
    gaze::OneEuroFilter one_euro({});
    const std::vector<CodedSample>& samples = recording.samples;
    for (std::size_t from = 0; from < samples.size(); ++from) {
        const CodedSample& sample = samples[from];
        predictor.add(sample.time_ns, sample.direction);
        if (!sample.direction) {
            one_euro.reset();
            continue;
        }
        const glm::dvec3 held = *sample.direction;
        const glm::dvec3 calmed = one_euro.add(sample.time_ns, held);
        const glm::dvec3 velocity = predictor.detector().velocity_deg_per_s();
        for (std::size_t h = 0; h < kHorizons_ms.size(); ++h) {
            const auto to = at_time(samples, from, sample.time_ns + kHorizons_ms[h] * 1'000'000);
            const auto target = to ? class_of(samples, from, *to) : std::nullopt;
            if (!target) {
                continue;
            }
            const CodedSample& truth = samples[*to];
            const double ahead_s = static_cast<double>(truth.time_ns - sample.time_ns) * 1e-9;
            const std::array<glm::dvec3, kPredictorNames.size()> predicted{
                held, glm::normalize(held + glm::radians(ahead_s) * velocity), calmed,
                predictor.predict(truth.time_ns).turn * held};
            Errors& cell = errors[static_cast<std::size_t>(*target)][h];
            for (std::size_t p = 0; p < predicted.size(); ++p) {
                cell[p].push_back(
                    glm::degrees(gaze::angle_between(predicted[p], *truth.direction)));
            }
        }
    }
}

}  // namespace

std::map<std::string, PersonErrors> prediction_errors(
    const std::vector<const CodedRecording*>& recordings) {
    std::map<std::string, PersonErrors> errors;
    for (const CodedRecording* const recording : recordings) {
        add_errors(*recording, errors[recording->person]);
    }
    return errors;
}

double percentile(std::vector<double> values, double percent) {
    const auto rank = static_cast<std::ptrdiff_t>(
        std::ceil(percent / 100.0 * static_cast<double>(values.size())));
    const auto at = values.begin() + std::max<std::ptrdiff_t>(rank, 1) - 1;
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

std::vector<double> ratios_to_hold(const std::map<std::string, PersonErrors>& errors,
                                   TargetClass target, std::size_t horizon, Predictor predictor) {
    std::vector<double> ratios;
    for (const auto& [person, of_person] : errors) {
        const Errors& cell = of_person[static_cast<std::size_t>(target)][horizon];
        if (cell.front().size() >= kFewestErrors) {
            ratios.push_back(percentile(cell[static_cast<std::size_t>(predictor)], 95.0) /
                             percentile(cell.front(), 95.0));
        }
    }
    return ratios;
}

}  // namespace gazeloop::tests
