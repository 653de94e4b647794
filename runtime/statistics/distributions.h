#pragma once

namespace gazeloop::statistics {

/// The probability that a standard normal variable is at most `z`. NaN for NaN.
[[nodiscard]] double normal_share(double z);

/// The z below which a share of a standard normal distribution lies, within 1e-12. Minus infinity
/// for 0, infinity for 1, NaN for anything outside [0, 1].
[[nodiscard]] double normal_quantile(double share);

/// The t below which a share of Student's distribution lies, within 1e-9 of its size. `share` in
/// [0.5, 1): the distribution is symmetric. Precondition: degrees_of_freedom > 0.
[[nodiscard]] double student_quantile(double share, unsigned degrees_of_freedom);

}  // namespace gazeloop::statistics
