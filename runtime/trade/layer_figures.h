#pragma once

#include <filesystem>
#include <string>

#include "runtime/error.h"

namespace gazeloop::trade {

/// Predicts what eccentricity layers save on displays as sharp as the fovea, over their field of
/// view (Guenter et al. 2012, Figures 12 and 13). Writes layers.csv, and speedup_a, speedup_b,
/// cost_full and cost_layers as .png and .svg, into a folder. A missing folder is made. Returns how
/// the paper's two claims hold, as text. Errors (BadInput): a file that cannot be written.
Expected<std::string> write_layer_figures(const std::filesystem::path& folder);

}  // namespace gazeloop::trade
