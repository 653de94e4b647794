#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "runtime/scene/gltf/load_limits.h"
#include "runtime/scene/mesh/mesh_data.h"

namespace gazeloop::scene::gltf {

enum class PictureKind : std::uint8_t { Png, Jpeg };

/// What a picture's header says.
struct PictureHeader {
    PictureKind kind = PictureKind::Png;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    mesh::TexelFormat format = mesh::TexelFormat::Rgba8;  ///< Rgba16: PNGs of 16 bits

    [[nodiscard]] std::uint64_t bytes() const {
        return std::uint64_t{width} * height * (format == mesh::TexelFormat::Rgba8 ? 4 : 8);
    }
};

/// Reads no more than the header. Refuses, by name, what is neither PNG nor JPEG, sides beyond the
/// limits, and pictures that their bytes cannot hold, however well they are packed.
[[nodiscard]] PictureHeader read_picture_header(std::span<const std::byte> bytes,
                                                const std::string& place, const LoadLimits& limits);

/// Decodes to four channels: grey, palettes and transparent colours become RGBA; colour profiles,
/// gamma and orientation in the file are not applied, as glTF asks. Notes a picture that ends
/// early. Sets width, height, format and texels. Throws Refusal.
void decode_picture(std::span<const std::byte> bytes, const PictureHeader& header,
                    const std::string& place, mesh::Image& image, Notes& notes);

}  // namespace gazeloop::scene::gltf
