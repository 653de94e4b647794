#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "runtime/error.h"
#include "runtime/render/host_picture.h"

namespace gazeloop::render {

/// The longest side that is read.
inline constexpr std::uint32_t kMaxPngSide_px = 16384;

/// Any PNG: grey or colour, 1 to 16 bits, with alpha (over black). What a file without a gamma
/// chunk holds is taken as sRGB-encoded. Errors (BadInput): not a PNG, cut short, damaged, or a
/// side over kMaxPngSide_px; it names file and reason.
Expected<LinearPicture> read_png(const std::filesystem::path& file);
/// The same for a file's bytes; `name` stands for the file in messages.
Expected<LinearPicture> read_png(std::span<const std::byte> bytes, const std::string& name);

/// Errors (BadInput): the file cannot be written; it names file and reason.
Expected<void> write_png(const Picture& picture, const std::filesystem::path& file);
/// The same file's bytes. Precondition: the picture has pixels.
[[nodiscard]] std::string png_bytes(const Picture& picture);

}  // namespace gazeloop::render
