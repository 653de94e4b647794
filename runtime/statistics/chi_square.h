#pragma once

namespace gazeloop::statistics {

/// The probability that a chi-square variable is at least `value`: the regularised upper incomplete
/// gamma function Q(df / 2, value / 2), within 1e-12. 1 for values up to 0, 0 for an
/// infinite one, NaN for NaN. Precondition: degrees_of_freedom > 0.
[[nodiscard]] double chi_square_tail(double value, unsigned degrees_of_freedom);

}  // namespace gazeloop::statistics
