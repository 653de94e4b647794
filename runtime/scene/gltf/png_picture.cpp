#include "runtime/scene/gltf/png_picture.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <csetjmp>
#include <cstring>
#include <vector>

namespace gazeloop::scene::gltf {
namespace {

/// What libpng reads from, and what it complains of.
struct PngInput {
    std::span<const std::byte> rest;
    std::array<char, 128> complaint{};
};

void read_bytes(png_structp png, png_bytep to, std::size_t count) {
    auto& input = *static_cast<PngInput*>(png_get_io_ptr(png));
    if (count > input.rest.size()) {
        png_error(png, "it ends early");
    }
    std::memcpy(to, input.rest.data(), count);
    input.rest = input.rest.subspan(count);
}

[[noreturn]] void keep_error(png_structp png, png_const_charp text) {
    auto& input = *static_cast<PngInput*>(png_get_error_ptr(png));
    std::strncpy(input.complaint.data(), text, input.complaint.size() - 1);
    png_longjmp(png, 1);
}

void pass_over(png_structp /*png*/, png_const_charp /*text*/) {}

/// Reads into `rows`. Plain types alone, since libpng jumps out of it. False: input.complaint says
/// why.
bool read_rows(PngInput& input, std::span<png_bytep> rows) {
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &input, keep_error, pass_over);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    if (info == nullptr) {
        png_destroy_read_struct(&png, nullptr, nullptr);
        std::strncpy(input.complaint.data(), "out of memory", input.complaint.size() - 1);
        return false;
    }
    if (setjmp(png_jmpbuf(png)) != 0) {
        png_destroy_read_struct(&png, &info, nullptr);
        return false;
    }
    png_set_read_fn(png, &input, read_bytes);
    // Texts, profiles, gamma: nothing of them counts, and they can unpack to gigabytes.
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_read_info(png, info);
    png_set_expand(png);  // palettes, grey below 8 bits, a transparent colour
    png_set_gray_to_rgb(png);
    png_set_add_alpha(png, 0xFFFF, PNG_FILLER_AFTER);
    if (std::endian::native == std::endian::little) {
        png_set_swap(png);
    }
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    png_read_image(png, rows.data());
    png_destroy_read_struct(&png, &info, nullptr);
    return true;
}

std::uint32_t big_endian_word(std::span<const std::byte> bytes, std::size_t at) {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        word = word << 8U | std::to_integer<std::uint32_t>(bytes[at + i]);
    }
    return word;
}

}  // namespace

PictureHeader read_png_header(std::span<const std::byte> bytes, const std::string& place) {
    // Signature, length and name of the first chunk, then its content (PNG specification, 11.2.2).
    constexpr std::size_t kName = 12;
    constexpr std::size_t kContent = 16;
    constexpr std::size_t kDepth = 24;
    constexpr std::string_view kFirst = "IHDR";
    if (bytes.size() <= kDepth || std::memcmp(&bytes[kName], kFirst.data(), kFirst.size()) != 0) {
        refuse(place, "is a PNG that ends inside its header");
    }
    return {.kind = PictureKind::Png,
            .width = big_endian_word(bytes, kContent),
            .height = big_endian_word(bytes, kContent + 4),
            .format = std::to_integer<int>(bytes[kDepth]) == 16 ? mesh::TexelFormat::Rgba16
                                                                : mesh::TexelFormat::Rgba8};
}

void decode_png(std::span<const std::byte> bytes, const std::string& place, mesh::Image& image) {
    PngInput input{.rest = bytes};
    std::vector<png_bytep> rows(image.height);
    const std::size_t row_bytes = image.texels.size() / image.height;
    for (std::size_t y = 0; y < rows.size(); ++y) {
        rows[y] = reinterpret_cast<png_bytep>(image.texels.data()) + y * row_bytes;
    }
    if (!read_rows(input, rows)) {
        refuse(place, fmt::format("is a PNG that cannot be decoded ({})", input.complaint.data()));
    }
}

}  // namespace gazeloop::scene::gltf
