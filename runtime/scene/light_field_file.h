#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/error.h"
#include "runtime/light_field/camera_grid.h"

namespace gazeloop::scene {

/// What the name of a light field's file ends in. Its pictures lie beside it.
inline constexpr std::string_view kLightFieldExtension = ".lightfield";

/// Whether a scene's name is that of a light field's file.
[[nodiscard]] bool is_light_field_file(std::string_view name);

/// What the file says: TOML with `columns`, `rows`, `spacing_m`, `horizontal_deg` and
/// `vertical_deg` (the field of view of each picture). Errors (BadInput), with "name:line" where
/// there is one: no TOML, a key that is missing, unknown or no number, a value out of its range
/// (light_field::CameraGrid).
[[nodiscard]] Expected<light_field::CameraGrid> read_light_field(std::istream& in,
                                                                 const std::string& name);
/// The same as text.
[[nodiscard]] std::string light_field_text(const light_field::CameraGrid& grid);

/// "view_03_07.png": row 3, column 7.
[[nodiscard]] std::string view_file_name(std::uint32_t row, std::uint32_t column);

/// A light field in memory.
struct LightFieldPictures {
    light_field::CameraGrid cameras;
    std::uint32_t width_px = 0;  ///< of every view
    std::uint32_t height_px = 0;
    /// RGBA, 8 bits, sRGB-encoded; view by view (CameraGrid), top row first.
    std::vector<std::vector<std::byte>> views;
};

/// Loads the views that lie beside a light field's file: PNG or JPEG pictures of 8 bits per channel
/// and one size, whose names end in row and column ("view_03_07.png", "3-7.jpg"). Errors
/// (BadInput): as read_light_field; views that are missing, there twice, beyond the grid, of
/// another size or damaged, and names without row and column, in one list; more than `most_bytes`
/// (4 bytes per texel), with what would fit.
[[nodiscard]] Expected<LightFieldPictures> load_light_field(const std::filesystem::path& file,
                                                            std::uint64_t most_bytes);

}  // namespace gazeloop::scene
