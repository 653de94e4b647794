#pragma once

#include <fmt/core.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/simulated_camera.h"

namespace gazeloop::tests {

/// The pixel formats that a frame extractor may write.
enum class FrameFormat { Grey8, Colour8, Grey16 };

inline double encoded_srgb(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

/// A PNG of 40x20 pixels: the lamp at 4,8,6,4, the patch at 24,8,8,4, both of linear light, the
/// rest dark. The first row counts the frames in its pixels, so that no two are the same, as a
/// camera's noise makes sure of.
class FrameWriter {
  public:
    static constexpr std::uint32_t kWidth = 40;
    static constexpr std::uint32_t kHeight = 20;
    static constexpr const char* kLamp = "4,8,6,4";
    static constexpr const char* kPatch = "24,8,8,4";

    explicit FrameWriter(FrameFormat format) : format_(format) {}

    void write(const std::filesystem::path& file, double lamp, double patch) {
        pixels8_.assign(std::size_t{kWidth} * kHeight * 3, 20);
        pixels16_.assign(std::size_t{kWidth} * kHeight, 500);
        for (std::size_t bit = 0; bit < kWidth; ++bit) {
            const bool set = (written_ >> bit & 1U) != 0;
            pixels8_[bit * channels()] = set ? 80 : 20;
            pixels16_[bit] = set ? 600 : 500;
        }
        ++written_;
        fill(4, 6, lamp);
        fill(24, 8, patch);
        png_image image{};
        image.version = PNG_IMAGE_VERSION;
        image.width = kWidth;
        image.height = kHeight;
        const void* pixels = pixels8_.data();
        switch (format_) {
            case FrameFormat::Grey8:
                image.format = PNG_FORMAT_GRAY;
                break;
            case FrameFormat::Colour8:
                image.format = PNG_FORMAT_RGB;
                break;
            case FrameFormat::Grey16:
                image.format = PNG_FORMAT_LINEAR_Y;
                pixels = pixels16_.data();
                break;
        }
        image.flags = PNG_IMAGE_FLAG_FAST;
        if (png_image_write_to_file(&image, file.c_str(), 0, pixels, 0, nullptr) == 0) {
            throw std::runtime_error(file.string() + ": " + image.message);
        }
    }

  private:
    void fill(std::uint32_t x0, std::uint32_t width, double light) {
        const auto code8 = static_cast<std::uint8_t>(std::lround(255.0 * encoded_srgb(light)));
        const auto code16 = static_cast<std::uint16_t>(std::lround(65535.0 * light));
        for (std::uint32_t y = 8; y < 12; ++y) {
            for (std::uint32_t x = x0; x < x0 + width; ++x) {
                const std::size_t pixel = std::size_t{y} * kWidth + x;
                std::fill_n(pixels8_.begin() + static_cast<std::ptrdiff_t>(pixel * channels()),
                            channels(), code8);
                pixels16_[pixel] = code16;
            }
        }
    }

    [[nodiscard]] std::size_t channels() const { return format_ == FrameFormat::Colour8 ? 3 : 1; }

    FrameFormat format_;
    std::uint64_t written_ = 0;
    std::vector<std::uint8_t> pixels8_;
    std::vector<std::uint16_t> pixels16_;
};

/// Films a truth into a folder: 000001.png ... Returns the number of frames.
inline std::size_t film(const std::filesystem::path& folder, FrameFormat format,
                        const CameraModel& camera, const LampAndDisplay& set_up, const Truth& truth,
                        std::uint64_t seed) {
    FrameWriter writer(format);
    SimulatedCamera simulated(camera, set_up, truth, seed);
    for (std::size_t frame = 1; frame <= simulated.frames(); ++frame) {
        const auto [lamp, patch] = simulated.next();
        writer.write(folder / fmt::format("{:06}.png", frame), lamp, patch);
    }
    return simulated.frames();
}

}  // namespace gazeloop::tests
