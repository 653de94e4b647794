#include "runtime/scene/gltf/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "runtime/scene/gltf/jpeg_picture.h"
#include "runtime/scene/gltf/png_picture.h"

namespace gazeloop::scene::gltf {
namespace {

bool starts_with(std::span<const std::byte> bytes, std::string_view prefix, std::size_t at = 0) {
    return bytes.size() >= at + prefix.size() &&
           std::ranges::equal(prefix, bytes.subspan(at, prefix.size()),
                              [](char a, std::byte b) { return static_cast<std::byte>(a) == b; });
}

/// What a file is that can't be read, by its first bytes.
std::string_view other_kind(std::span<const std::byte> bytes) {
    if (bytes.empty()) {
        return "an empty file";
    }
    if (starts_with(bytes, "RIFF") && starts_with(bytes, "WEBP", 8)) {
        return "a WebP picture";
    }
    if (starts_with(bytes, "\xABKTX 20")) {
        return "a KTX2 texture";
    }
    if (starts_with(bytes, "DDS ")) {
        return "a DDS texture";
    }
    if (starts_with(bytes, "GIF8")) {
        return "a GIF picture";
    }
    if (starts_with(bytes, "ftypavif", 4)) {
        return "an AVIF picture";
    }
    if (starts_with(bytes, "BM")) {
        return "a BMP picture";
    }
    return "no picture that is known";
}

/// A bomb states sides that its bytes cannot fill. deflate packs at most 1032 to 1; of a JPEG, a
/// block of 64 samples takes a bit at least, and the sparsest plane has one sample of 16 texels.
void check_packing(const PictureHeader& header, std::size_t bytes, const std::string& place) {
    const std::uint64_t texels = std::uint64_t{header.width} * header.height;
    const std::uint64_t most = header.kind == PictureKind::Png
                                   ? std::uint64_t{bytes} * 1032 * 8  // a bit per texel
                                   : std::uint64_t{bytes} * 8 * 64 * 16;
    if (texels > most) {
        refuse(place, fmt::format("states {}x{} texels, which its {} bytes cannot hold",
                                  header.width, header.height, bytes));
    }
}

}  // namespace

PictureHeader read_picture_header(std::span<const std::byte> bytes, const std::string& place,
                                  const LoadLimits& limits) {
    PictureHeader header;
    if (starts_with(bytes, "\x89PNG\r\n\x1A\n")) {
        header = read_png_header(bytes, place);
    } else if (starts_with(bytes, "\xFF\xD8\xFF")) {
        header = read_jpeg_header(bytes, place);
    } else {
        refuse(place, fmt::format("is {}; PNG and JPEG are read, export it as one of them",
                                  other_kind(bytes)));
    }
    if (header.width == 0 || header.height == 0 ||
        std::max(header.width, header.height) > limits.most_texels_per_side) {
        refuse(place, fmt::format("has {}x{} texels, must have 1 to {} a side; make it smaller",
                                  header.width, header.height, limits.most_texels_per_side));
    }
    check_packing(header, bytes.size(), place);
    return header;
}

void decode_picture(std::span<const std::byte> bytes, const PictureHeader& header,
                    const std::string& place, mesh::Image& image, Notes& notes) {
    image.width = header.width;
    image.height = header.height;
    image.format = header.format;
    image.texels.resize(header.bytes());
    if (header.kind == PictureKind::Png) {
        decode_png(bytes, place, image);
    } else {
        decode_jpeg(bytes, place, image, notes);
    }
}

}  // namespace gazeloop::scene::gltf
