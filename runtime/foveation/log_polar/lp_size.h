#pragma once

#include <cstdint>

namespace gazeloop::foveation {

/// Size of an LP-buffer: columns run outward from the fovea, rows around it.
struct LpSize {
    static constexpr std::uint32_t kMinWidth = 2;
    static constexpr std::uint32_t kMinHeight = 4;
    static constexpr std::uint32_t kMaxSide = 16384;

    std::uint32_t width = 0;
    std::uint32_t height = 0;
    friend bool operator==(const LpSize&, const LpSize&) = default;

    [[nodiscard]] bool in_range() const {
        return width >= kMinWidth && height >= kMinHeight && width <= kMaxSide &&
               height <= kMaxSide;
    }
};

}  // namespace gazeloop::foveation
