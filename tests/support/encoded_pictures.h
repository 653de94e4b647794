#pragma once

#include <png.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <vector>
// libjpeg's own header needs FILE and size_t before it.
#include <jpeglib.h>

namespace gazeloop::tests {

/// A PNG of these pixels, in one of libpng's PNG_FORMAT_; a palette (of RGBA) for those with one.
inline std::vector<std::byte> encoded_png(std::uint32_t width, std::uint32_t height,
                                          std::uint32_t format, const void* pixels,
                                          const std::vector<std::uint8_t>& palette = {}) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = width;
    image.height = height;
    image.format = format;
    image.colormap_entries = static_cast<png_uint_32>(palette.size() / 4);
    const void* const colors = palette.empty() ? nullptr : palette.data();
    png_alloc_size_t size = 0;
    if (png_image_write_to_memory(&image, nullptr, &size, 0, pixels, 0, colors) == 0) {
        throw std::runtime_error(image.message);
    }
    std::vector<std::byte> bytes(size);
    if (png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels, 0, colors) == 0) {
        throw std::runtime_error(image.message);
    }
    bytes.resize(size);
    return bytes;
}

/// A JPEG of these pixels of `channels` samples.
inline std::vector<std::byte> encoded_jpeg(std::uint32_t width, std::uint32_t height,
                                           J_COLOR_SPACE colors, int channels,
                                           std::vector<std::uint8_t> pixels) {
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* to = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &to, &size);
    jpeg.image_width = width;
    jpeg.image_height = height;
    jpeg.input_components = channels;
    jpeg.in_color_space = colors;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, 95, TRUE);
    jpeg_start_compress(&jpeg, TRUE);
    while (jpeg.next_scanline < height) {
        JSAMPROW row =
            &pixels[std::size_t{jpeg.next_scanline} * width * static_cast<unsigned>(channels)];
        jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    const auto* const first = reinterpret_cast<const std::byte*>(to);
    std::vector<std::byte> bytes(first, first + size);
    std::free(to);  // NOLINT(cppcoreguidelines-no-malloc): as libjpeg asks
    return bytes;
}

}  // namespace gazeloop::tests
