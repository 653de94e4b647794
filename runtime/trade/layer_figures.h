#pragma once

#include <filesystem>
#include <string>

#include "runtime/error.h"

namespace gazeloop::trade {

/// Predicts what eccentricity layers save on displays as sharp as the fovea, over their field of
/// view (Guenter et al. 2012, Figures 12 and 13), and writes it into a folder, which is made if it
/// is missing: layers.csv, and speedup_a, speedup_b, cost_full, cost_layers as .png and .svg.
/// Returns what became of the paper's two claims, as text. Errors (BadInput): a file that cannot be
/// written.
Expected<std::string> write_layer_figures(const std::filesystem::path& folder);

}  // namespace gazeloop::trade
