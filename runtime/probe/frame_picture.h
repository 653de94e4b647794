#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "runtime/error.h"
#include "runtime/probe/region.h"

namespace gazeloop::probe {

/// One frame of a camera: luminance in linear light, since times between frames follow from light
/// that adds up. Any PNG is read: grey or colour, 1 to 16 bits, with alpha (over black). What a
/// file without a gamma chunk holds is taken as sRGB-encoded, 16 bits too, as videos are. The
/// memory is used again by the next read.
class FramePicture {
  public:
    /// Errors (BadInput): not a PNG, cut short, damaged, or too large. Names file and reason.
    [[nodiscard]] Expected<void> read(const std::filesystem::path& file);
    /// The same for a file's bytes; `name` stands for the file in messages.
    [[nodiscard]] Expected<void> read(std::span<const std::byte> bytes, const std::string& name);

    [[nodiscard]] std::uint32_t width() const { return width_; }
    [[nodiscard]] std::uint32_t height() const { return height_; }
    /// Mean luminance, 0 .. 1. Precondition: the region lies inside.
    [[nodiscard]] double brightness(const Region& region) const;
    /// Whether every pixel is the same.
    [[nodiscard]] bool same_as(const FramePicture& other) const {
        return width_ == other.width_ && height_ == other.height_ && pixels_ == other.pixels_;
    }

  private:
    std::uint32_t width_ = 0;
    std::uint32_t height_ = 0;
    std::vector<std::uint8_t> codes_;    ///< as 8-bit files hold them
    std::vector<std::uint16_t> pixels_;  ///< linear light
};

}  // namespace gazeloop::probe
