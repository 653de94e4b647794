#pragma once

#include <filesystem>
#include <istream>
#include <string>
#include <string_view>

#include "runtime/foveation/log_polar/table_kernel.h"

namespace gazeloop::methods {

/// A kernel's samples as text, from the fovea outward: lines of "x,y". A first line of names, empty
/// lines and lines that begin with # are skipped. With `toml`, an array of pairs:
///     kernel = [[0, 0], [0.5, 0.1], [1, 1]]
/// Errors (BadInput), with "name:line": a file that cannot be read, a cell that is no number,
/// samples that break TableKernel's rules.
Expected<foveation::TableKernel> read_kernel_table(std::istream& in, const std::string& name,
                                                   bool toml);

/// A kernel's samples in one line, "x,y;x,y;...": each number with the fewest digits that give the
/// same double again. And back; errors (BadInput) as above, with "name:pair".
std::string kernel_samples(const foveation::TableKernel& kernel);
Expected<foveation::TableKernel> read_kernel_samples(std::string_view samples,
                                                     const std::string& name);

/// From a file: TOML if its name ends in .toml.
Expected<foveation::TableKernel> load_kernel_table(const std::filesystem::path& file);

}  // namespace gazeloop::methods
