#pragma once

#include <algorithm>
#include <cmath>
#include <vulkan/vulkan.hpp>

namespace gazeloop::present {

/// A picture of this share of a size: at least 2x2, which the maps need, but never more than
/// `most`.
inline vk::Extent2D scaled_extent(vk::Extent2D size, double scale, vk::Extent2D most) {
    const auto scaled = [scale](std::uint32_t side, std::uint32_t greatest) {
        const double wanted = std::max(std::round(side * scale), 2.0);
        return wanted < greatest ? static_cast<std::uint32_t>(wanted) : greatest;
    };
    return {scaled(size.width, most.width), scaled(size.height, most.height)};
}

}  // namespace gazeloop::present
