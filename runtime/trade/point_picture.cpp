#include "runtime/trade/point_picture.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "runtime/quality/heat_map.h"
#include "runtime/render/png_file.h"
#include "runtime/render/srgb.h"
#include "runtime/report/page/base64.h"

namespace gazeloop::trade {
namespace {

/// Means of squares of `side` pixels; what is left at the right and lower edge is a part of one.
template <typename Value>
std::vector<Value> means(const std::vector<Value>& values, std::uint32_t width,
                         std::uint32_t height, std::uint32_t side) {
    std::vector<Value> small;
    for (std::uint32_t top = 0; top < height; top += side) {
        for (std::uint32_t left = 0; left < width; left += side) {
            Value sum{};
            const std::uint32_t bottom = std::min(top + side, height);
            const std::uint32_t right = std::min(left + side, width);
            for (std::uint32_t y = top; y < bottom; ++y) {
                for (std::uint32_t x = left; x < right; ++x) {
                    sum += values[std::size_t{y} * width + x];
                }
            }
            small.push_back(sum / static_cast<float>((bottom - top) * (right - left)));
        }
    }
    return small;
}

std::uint32_t side_of(std::uint32_t width, std::uint32_t height) {
    return (std::max(width, height) + kMostPictureSide_px - 1) / kMostPictureSide_px;
}

std::uint32_t parts(std::uint32_t size, std::uint32_t side) { return (size + side - 1) / side; }

std::string png_in_base64(const render::Picture& picture) {
    return report::page::base64(render::png_bytes(picture));
}

}  // namespace

std::string small_picture(const render::LinearPicture& picture) {
    const std::uint32_t side = side_of(picture.width, picture.height);
    render::Picture small{parts(picture.width, side), parts(picture.height, side), {}};
    for (const glm::vec3& colour : means(picture.pixels, picture.width, picture.height, side)) {
        constexpr double kMost = 255.0;
        std::array<std::uint8_t, 3> codes{};
        for (int channel = 0; channel < 3; ++channel) {
            codes.at(static_cast<std::size_t>(channel)) = static_cast<std::uint8_t>(
                std::lround(kMost * render::srgb_encoded(double{colour[channel]})));
        }
        small.pixels.push_back(codes);
    }
    return png_in_base64(small);
}

std::string small_heat_map(const quality::FrameQuality& quality) {
    const bool contrast = quality.contrast && !quality.contrast->map.values.empty();
    if (!contrast && (!quality.flip || quality.flip->map.values.empty())) {
        return {};
    }
    const quality::Plane& map = contrast ? quality.contrast->map : quality.flip->map;
    const std::uint32_t side = side_of(map.width, map.height);
    quality::Plane small(parts(map.width, side), parts(map.height, side));
    small.values = means(map.values, map.width, map.height, side);
    return png_in_base64(quality::heat_map(small, contrast ? quality::kContrastMapMost : 1.0));
}

}  // namespace gazeloop::trade
