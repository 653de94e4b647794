#pragma once

#include "runtime/scene/gltf/picture.h"

namespace gazeloop::scene::gltf {

/// As read_picture_header(), of a JPEG; its limits are not checked here.
[[nodiscard]] PictureHeader read_jpeg_header(std::span<const std::byte> bytes,
                                             const std::string& place);

/// Fills `image.texels`, which has the header's size. Notes a picture that is damaged and shown.
void decode_jpeg(std::span<const std::byte> bytes, const std::string& place, mesh::Image& image,
                 Notes& notes);

}  // namespace gazeloop::scene::gltf
