#include "tests/support/coded/event_agreement.h"

#include <glm/trigonometric.hpp>

#include "runtime/gaze/direction.h"
#include "runtime/gaze/events/event_detector.h"

namespace gazeloop::tests {

double Kappa::value() const {
    const auto of = [this](int first, int second) {
        return static_cast<double>(counts_[first][second]);
    };
    const double all = of(0, 0) + of(0, 1) + of(1, 0) + of(1, 1);
    const double agreed = (of(0, 0) + of(1, 1)) / all;
    const double first_yes = (of(1, 0) + of(1, 1)) / all;
    const double second_yes = (of(0, 1) + of(1, 1)) / all;
    const double chance = first_yes * second_yes + (1.0 - first_yes) * (1.0 - second_yes);
    return (agreed - chance) / (1.0 - chance);
}

Labels labels_of_coder(const CodedRecording& recording, int coder) {
    Labels labels;
    for (const CodedSample& sample : recording.samples) {
        labels.push_back(coder == 0 ? sample.first_coder : sample.second_coder);
    }
    return labels;
}

Labels detected_labels(const CodedRecording& recording) {
    gaze::EventDetector detector;
    Labels labels;
    for (const CodedSample& sample : recording.samples) {
        detector.add(sample.time_ns, sample.direction);
        if (&sample != recording.samples.data()) {
            labels.push_back(
                static_cast<int>(detector.event_before().value_or(gaze::EyeEvent::Fixation)));
        }
    }
    labels.push_back(static_cast<int>(detector.event()));
    return labels;
}

Labels velocity_threshold_labels(const CodedRecording& recording, double threshold_deg_per_s) {
    const std::vector<CodedSample>& samples = recording.samples;
    Labels labels(samples.size(), static_cast<int>(gaze::EyeEvent::Fixation));
    for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
        const CodedSample& before = samples[i - 1];
        const CodedSample& after = samples[i + 1];
        if (before.direction && after.direction &&
            glm::degrees(gaze::angle_between(*before.direction, *after.direction)) >
                threshold_deg_per_s * static_cast<double>(after.time_ns - before.time_ns) * 1e-9) {
            labels[i] = static_cast<int>(gaze::EyeEvent::Saccade);
        }
    }
    return labels;
}

}  // namespace gazeloop::tests
