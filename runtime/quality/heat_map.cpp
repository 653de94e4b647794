#include "runtime/quality/heat_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace gazeloop::quality {
namespace {

/// Evenly spaced; each is brighter than the one before, so that it can be read without colours.
constexpr std::array<glm::vec3, 5> kStops{
    glm::vec3(0.0F, 0.0F, 0.0F), glm::vec3(70.0F, 20.0F, 120.0F), glm::vec3(205.0F, 50.0F, 65.0F),
    glm::vec3(250.0F, 165.0F, 30.0F), glm::vec3(255.0F, 255.0F, 255.0F)};

}  // namespace

render::Picture heat_map(const Plane& map, double most) {
    constexpr float kSpread = 15.0F;
    const auto over_most = static_cast<float>(kSpread / most);
    const float scale = static_cast<float>(kStops.size() - 1) / std::log1p(kSpread);
    render::Picture picture{map.width, map.height, {}};
    picture.pixels.reserve(map.values.size());
    for (const float value : map.values) {
        const float at = std::clamp(std::log1p(std::max(value, 0.0F) * over_most) * scale, 0.0F,
                                    static_cast<float>(kStops.size() - 1));
        const std::size_t below = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
        const glm::vec3 colour =
            glm::mix(kStops[below], kStops[below + 1], at - static_cast<float>(below));
        picture.pixels.push_back({static_cast<std::uint8_t>(std::lround(colour.x)),
                                  static_cast<std::uint8_t>(std::lround(colour.y)),
                                  static_cast<std::uint8_t>(std::lround(colour.z))});
    }
    return picture;
}

}  // namespace gazeloop::quality
