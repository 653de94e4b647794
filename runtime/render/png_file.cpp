#include "runtime/render/png_file.h"

#include <fmt/core.h>
#include <png.h>

#include <array>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "runtime/files/output_file.h"
#include "runtime/render/srgb.h"

namespace gazeloop::render {
namespace {

std::unexpected<Error> refuse(const std::string& name, std::string_view why) {
    return std::unexpected(
        Error{ErrorKind::BadInput, fmt::format("{}: cannot be read as a PNG ({})", name, why)});
}

png_image new_image() {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    return image;
}

/// Deflate makes at most so many bytes of one.
constexpr std::uint64_t kMostInflation = 1032;

/// Decodes what was begun, of a file of so many bytes.
Expected<LinearPicture> finish(png_image& image, const std::string& name, std::uint64_t bytes) {
    if (image.width > kMaxPngSide_px || image.height > kMaxPngSide_px) {
        const std::string size = fmt::format("{}x{}", image.width, image.height);
        png_image_free(&image);
        return refuse(name, fmt::format("{} pixels: a side is over {} px", size, kMaxPngSide_px));
    }
    const std::size_t count = std::size_t{image.width} * image.height;
    // At a bit per pixel. No memory is taken for what a damaged header claims.
    if (count / 8 > kMostInflation * bytes) {
        const std::string size = fmt::format("{}x{}", image.width, image.height);
        png_image_free(&image);
        return refuse(name, fmt::format("too short for {} pixels", size));
    }
    LinearPicture picture{image.width, image.height, {}};
    // libpng takes 8-bit files to linear light in 8 bits, which dark colours do not survive.
    if ((image.format & PNG_FORMAT_FLAG_LINEAR) == 0) {
        image.format = PNG_FORMAT_RGB;
        std::vector<std::array<std::uint8_t, 3>> codes(count);
        const png_color black{};
        if (png_image_finish_read(&image, &black, codes.data(), 0, nullptr) == 0) {
            return refuse(name, image.message);
        }
        picture.pixels.reserve(count);
        for (const auto& code : codes) {
            picture.pixels.push_back(linear_of(code));
        }
        return picture;
    }
    const bool alpha = (image.format & PNG_FORMAT_FLAG_ALPHA) != 0;
    image.format = alpha ? PNG_FORMAT_LINEAR_RGB_ALPHA : PNG_FORMAT_LINEAR_RGB;
    image.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
    const std::size_t channels = alpha ? 4 : 3;  // premultiplied: over black, alpha says no more
    std::vector<std::uint16_t> values(count * channels);
    if (png_image_finish_read(&image, nullptr, values.data(), 0, nullptr) == 0) {
        return refuse(name, image.message);
    }
    picture.pixels.reserve(count);
    for (std::size_t at = 0; at < values.size(); at += channels) {
        picture.pixels.push_back(glm::vec3(values[at], values[at + 1], values[at + 2]) / 65535.0F);
    }
    return picture;
}

png_image image_of(const Picture& picture) {
    png_image image = new_image();
    image.width = picture.width;
    image.height = picture.height;
    image.format = PNG_FORMAT_RGB;
    return image;
}

/// The picture's PNG. None: `image` has the reason.
std::optional<std::string> encoded(const Picture& picture, png_image& image) {
    std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
    png_alloc_size_t size = bytes.size();
    if (png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.pixels.data(), 0,
                                  nullptr) == 0) {
        return std::nullopt;
    }
    bytes.resize(size);
    return bytes;
}

}  // namespace

Expected<LinearPicture> read_png(const std::filesystem::path& file) {
    png_image image = new_image();
    if (png_image_begin_read_from_file(&image, file.c_str()) == 0) {
        return refuse(file.string(), image.message);
    }
    std::error_code unknown;
    const std::uintmax_t bytes = std::filesystem::file_size(file, unknown);
    // A device or pipe has no size; libpng finds its end.
    return finish(image, file.string(), unknown ? kMaxPngSide_px * kMaxPngSide_px : bytes);
}

Expected<LinearPicture> read_png(std::span<const std::byte> bytes, const std::string& name) {
    png_image image = new_image();
    if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) {
        return refuse(name, image.message);
    }
    return finish(image, name, bytes.size());
}

Expected<void> write_png(const Picture& picture, const std::filesystem::path& file) {
    png_image image = image_of(picture);
    // Not to the file: libpng removes what it could not write, even a device.
    const std::optional<std::string> bytes = encoded(picture, image);
    if (!bytes) {
        return std::unexpected(Error{
            ErrorKind::BadInput,
            fmt::format("{}: the picture cannot be a PNG ({})", file.string(), image.message)});
    }
    return files::write_text(file, *bytes);
}

std::string png_bytes(const Picture& picture) {
    png_image image = image_of(picture);
    std::optional<std::string> bytes = encoded(picture, image);
    if (!bytes) {
        throw std::runtime_error(image.message);  // out of memory: nothing else can happen here
    }
    return *std::move(bytes);
}

}  // namespace gazeloop::render
