#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>
#include <random>

#include "runtime/gaze/view.h"
#include "runtime/render/host_picture.h"
#include "runtime/render/srgb.h"

namespace gazeloop::tests {

/// `colour(x, y)` at every pixel, linear.
template <typename Colour>
render::LinearPicture made_picture(std::uint32_t width, std::uint32_t height,
                                   const Colour& colour) {
    render::LinearPicture picture{width, height, {}};
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            picture.pixels.push_back(glm::vec3(colour(static_cast<int>(x), static_cast<int>(y))));
        }
    }
    return picture;
}

inline render::LinearPicture grey_picture(std::uint32_t width, std::uint32_t height, float value) {
    return made_picture(width, height, [=](int, int) { return glm::vec3(value); });
}

/// Blobs, edges and fine texture; seeded, linear, in [0, 1].
inline render::LinearPicture textured_picture(std::uint32_t width, std::uint32_t height,
                                              unsigned seed = 1) {
    std::mt19937 random(seed);
    const auto draw = [&] { return static_cast<float>(random() >> 8U) * 0x1p-24F; };
    const float a = 0.02F + 0.05F * draw();
    const float b = 0.3F + 0.4F * draw();
    return made_picture(width, height, [&](int x, int y) {
        const auto fx = static_cast<float>(x);
        const auto fy = static_cast<float>(y);
        const float slow = 0.4F + 0.2F * std::sin(a * fx) * std::cos(a * 1.3F * fy);
        const float fine = 0.1F * std::sin(b * (fx + 0.6F * fy));
        const float edge = (x / 23 + y / 31) % 2 == 0 ? 0.12F : 0.0F;
        const float grain = 0.06F * (draw() - 0.5F);
        return glm::vec3(slow + fine + edge + grain, slow + edge + grain, slow + 0.5F * fine);
    });
}

/// Each pixel the mean of those within `reach` px each way; the same as at the edges beyond them.
inline render::LinearPicture box_blurred(const render::LinearPicture& picture, int reach) {
    const auto at = [&](int x, int y) {
        x = std::clamp(x, 0, static_cast<int>(picture.width) - 1);
        y = std::clamp(y, 0, static_cast<int>(picture.height) - 1);
        return picture
            .pixels[static_cast<std::size_t>(y) * picture.width + static_cast<std::size_t>(x)];
    };
    return made_picture(picture.width, picture.height, [&](int x, int y) {
        glm::vec3 sum(0.0F);
        for (int j = -reach; j <= reach; ++j) {
            for (int i = -reach; i <= reach; ++i) {
                sum += at(x + i, y + j);
            }
        }
        return sum / static_cast<float>((2 * reach + 1) * (2 * reach + 1));
    });
}

/// A symmetrical view, `half_deg` to the left and right.
inline gaze::EyeView flat_view(std::uint32_t width, std::uint32_t height, double half_deg) {
    const double half_rad = half_deg * std::numbers::pi / 180.0;
    const double up_rad =
        std::atan(std::tan(half_rad) * static_cast<double>(height) / static_cast<double>(width));
    return {.fov = {-half_rad, half_rad, up_rad, -up_rad}, .width_px = width, .height_px = height};
}

/// A direction so many degrees to the right and up.
inline glm::dvec3 looking(double right_deg, double up_deg = 0.0) {
    return {std::tan(glm::radians(right_deg)), std::tan(glm::radians(up_deg)), -1.0};
}

}  // namespace gazeloop::tests
