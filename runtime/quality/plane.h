#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gazeloop::quality {

/// One number per pixel, top row first.
struct Plane {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<float> values;

    Plane() = default;
    Plane(std::uint32_t width_px, std::uint32_t height_px)
        : width(width_px), height(height_px), values(std::size_t{width_px} * height_px) {}

    /// Of this size; what it held then means nothing.
    void resize(std::uint32_t width_px, std::uint32_t height_px) {
        width = width_px;
        height = height_px;
        values.resize(std::size_t{width_px} * height_px);
    }

    [[nodiscard]] float* row(std::uint32_t y) { return values.data() + std::size_t{y} * width; }
    [[nodiscard]] const float* row(std::uint32_t y) const {
        return values.data() + std::size_t{y} * width;
    }
};

}  // namespace gazeloop::quality
