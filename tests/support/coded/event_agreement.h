#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tests/support/coded/coded_recordings.h"

namespace gazeloop::tests {

/// Cohen's kappa of two raters who say of each sample yes or no (Cohen 1960): how far they agree
/// beyond chance. 1: wholly, 0: as by chance.
class Kappa {
  public:
    void add(bool first, bool second) { ++counts_[first ? 1 : 0][second ? 1 : 0]; }
    /// Not-a-number where both say the same of all, or there is nothing.
    [[nodiscard]] double value() const;

  private:
    std::uint64_t counts_[2][2] = {};
};

/// What a rater says of each sample of a recording, in the numbers of the coders.
using Labels = std::vector<int>;

[[nodiscard]] Labels labels_of_coder(const CodedRecording& recording, int coder);
/// By the event detector as it runs in the loop, with its one sample of look-ahead.
[[nodiscard]] Labels detected_labels(const CodedRecording& recording);
/// Plain I-VT (Salvucci and Goldberg 2000): saccade where the speed, from the sample before to the
/// one after, is above the threshold; else fixation.
[[nodiscard]] Labels velocity_threshold_labels(const CodedRecording& recording,
                                               double threshold_deg_per_s);

/// Agreement on one kind of event, over all samples of the recordings together.
template <typename First, typename Second>
[[nodiscard]] double agreement(std::span<const CodedRecording* const> recordings, int event,
                               const First& first, const Second& second) {
    Kappa kappa;
    for (const CodedRecording* const recording : recordings) {
        const Labels a = first(*recording);
        const Labels b = second(*recording);
        for (std::size_t i = 0; i < a.size(); ++i) {
            kappa.add(a[i] == event, b[i] == event);
        }
    }
    return kappa.value();
}

}  // namespace gazeloop::tests
