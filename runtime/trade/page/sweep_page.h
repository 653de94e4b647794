#pragma once

#include <string>

#include "runtime/trade/sweep_report.h"

namespace gazeloop::trade {

/// A sweep as one HTML file that needs nothing else: for each case the fronts of samples and of
/// time against quality with their tables, and pictures of the points on them (kMostPictureBytes in
/// all, the first cases first). Its numbers are those of sweep_json(). Texts are any bytes: what
/// they hold is shown, and never becomes a part of the page's own language. Precondition: choose()
/// takes the question.
[[nodiscard]] std::string sweep_page(const SweepReport& report);

/// Of pictures and heat maps, in base64.
inline constexpr std::size_t kMostPictureBytes = std::size_t{24} << 20U;

}  // namespace gazeloop::trade
