#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace gazeloop::statistics {

/// Yes or no, of each subject to each treatment.
struct BinaryAnswers {
    std::size_t treatments = 0;
    /// Subject by subject; 0 is no, anything else yes.
    std::vector<std::uint8_t> answers;
};

struct CochransQ {
    double q = 0.0;
    unsigned degrees_of_freedom = 0;  ///< one less than there are treatments
    double p = 1.0;                   ///< that chance alone gives such a q or more
};

/// Whether treatments are answered alike by the same subjects (Cochran 1950):
///     Q = (k - 1) (k sum C^2 - T^2) / (k T - sum R^2)
/// of the yeses per treatment C, per subject R, and in all T; chi-square with k - 1 degrees of
/// freedom, which is close from about 24 answers of subjects who did not answer all alike. None:
/// fewer than two treatments, an incomplete subject, or every subject answered all treatments
/// alike, which says nothing.
[[nodiscard]] std::optional<CochransQ> cochrans_q(const BinaryAnswers& answers);

/// The p of a published Q, of so many treatments. Precondition: treatments > 1.
[[nodiscard]] double p_of_cochrans_q(double q, std::size_t treatments);

}  // namespace gazeloop::statistics
