#include "runtime/probe/frame_picture.h"

#include <fmt/core.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace gazeloop::probe {
namespace {

/// More than any camera has: 2^28 pixels take half a gigabyte.
constexpr std::uint64_t kMostPixels = 1ULL << 28U;

std::unexpected<Error> refuse(const std::string& name, std::string_view why) {
    return std::unexpected(
        Error{ErrorKind::BadInput, fmt::format("{}: cannot be read as a PNG ({})", name, why)});
}

png_image new_image() {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    return image;
}

/// IEC 61966-2-1, of 8 bits to 16 bits in linear light.
std::array<std::uint16_t, 256> linear_light() {
    std::array<std::uint16_t, 256> linear{};
    for (std::size_t code = 0; code < linear.size(); ++code) {
        const double c = static_cast<double>(code) / 255.0;
        const double light = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
        linear[code] = static_cast<std::uint16_t>(std::lround(65535.0 * light));
    }
    return linear;
}

/// Decodes what was begun. Where it fails, the pixels mean nothing.
Expected<void> finish(png_image& image, const std::string& name, std::vector<std::uint8_t>& codes,
                      std::vector<std::uint16_t>& pixels) {
    const std::size_t count = std::size_t{image.width} * image.height;
    if (count > kMostPixels) {
        png_image_free(&image);
        return refuse(name, fmt::format("{}x{} pixels are too many", image.width, image.height));
    }
    pixels.resize(count);
    // libpng takes 8-bit files to linear light in 8 bits, which dark lights do not survive.
    const bool deep = (image.format & PNG_FORMAT_FLAG_LINEAR) != 0;
    void* to = pixels.data();
    if (deep) {
        image.format = PNG_FORMAT_LINEAR_Y;
        image.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
    } else {
        image.format = PNG_FORMAT_GRAY;
        codes.resize(count);
        to = codes.data();
    }
    const png_color black{};
    if (png_image_finish_read(&image, deep ? nullptr : &black, to, 0, nullptr) == 0) {
        return refuse(name, image.message);
    }
    if (!deep) {
        static const std::array<std::uint16_t, 256> kLinear = linear_light();
        std::ranges::transform(codes, pixels.begin(),
                               [](std::uint8_t code) { return kLinear[code]; });
    }
    return {};
}

}  // namespace

Expected<void> FramePicture::read(const std::filesystem::path& file) {
    png_image image = new_image();
    if (png_image_begin_read_from_file(&image, file.c_str()) == 0) {
        return refuse(file.string(), image.message);
    }
    width_ = image.width;
    height_ = image.height;
    return finish(image, file.string(), codes_, pixels_);
}

Expected<void> FramePicture::read(std::span<const std::byte> bytes, const std::string& name) {
    png_image image = new_image();
    if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) {
        return refuse(name, image.message);
    }
    width_ = image.width;
    height_ = image.height;
    return finish(image, name, codes_, pixels_);
}

double FramePicture::brightness(const Region& region) const {
    std::uint64_t sum = 0;
    for (std::uint32_t y = region.y; y < region.y + region.height; ++y) {
        const std::size_t row = std::size_t{y} * width_;
        for (std::uint32_t x = region.x; x < region.x + region.width; ++x) {
            sum += pixels_[row + x];
        }
    }
    const double pixels = static_cast<double>(region.width) * region.height;
    return static_cast<double>(sum) / (65535.0 * pixels);
}

}  // namespace gazeloop::probe
