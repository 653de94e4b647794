#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/error.h"
#include "runtime/light_field/camera_grid.h"
#include "runtime/memory/large_pages.h"

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

/// A light field that can be read, view by view.
struct LightFieldSource {
    /// RGBA, 8 bits, sRGB-encoded, top row first.
    using Texels = memory::LargePagesVector<std::byte>;
    /// What becomes of a view's texels before it is taken; called by several threads at once.
    using Prepare = std::function<Texels(Texels)>;
    using Take = std::function<Expected<void>(std::uint32_t view, const Texels& prepared)>;

    std::string name;
    light_field::CameraGrid cameras;
    std::uint32_t width_px = 0;  ///< of every view
    std::uint32_t height_px = 0;
    /// Hands over all views in their order (CameraGrid), a few of them in memory at a time. Errors:
    /// those of `take`; (BadInput) of the views, all in one list.
    std::function<Expected<void>(const Prepare&, const Take&)> read;
};

/// The views that lie beside a light field's file: PNG or JPEG pictures of 8 bits per channel and
/// one size, whose names end in row and column ("view_03_07.png", "3-7.jpg"). Errors (BadInput): as
/// read_light_field; views that are missing, there twice, or beyond the grid, and names without row
/// and column, in one list with those that are damaged or of another size. Where only such are,
/// reading it finds them.
[[nodiscard]] Expected<LightFieldSource> open_light_field(const std::filesystem::path& file);

}  // namespace gazeloop::scene
