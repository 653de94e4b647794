#pragma once

#include "runtime/scene/gltf/picture.h"

namespace gazeloop::scene::gltf {

/// As read_picture_header(), of a PNG; its limits are not checked here.
[[nodiscard]] PictureHeader read_png_header(std::span<const std::byte> bytes,
                                            const std::string& place);

/// Fills `image.texels`, which has the header's size.
void decode_png(std::span<const std::byte> bytes, const std::string& place, mesh::Image& image);

}  // namespace gazeloop::scene::gltf
