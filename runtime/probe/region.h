#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "runtime/error.h"

namespace gazeloop::probe {

/// A rectangle of a camera's picture, pixels, origin top-left.
struct Region {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;

    [[nodiscard]] double middle_row() const { return y + 0.5 * height; }
    friend bool operator==(const Region&, const Region&) = default;
};

/// From "X,Y,W,H". `name` is what the region shows, for messages. Errors (Usage): no four whole
/// numbers, or an empty region.
[[nodiscard]] Expected<Region> parse_region(std::string_view name, std::string_view text);

/// Errors (Usage): lamp and patch share pixels.
[[nodiscard]] Expected<void> check_regions_apart(const Region& lamp, const Region& patch);

/// Errors (Usage): the region lies outside a picture of this size, or reaches out of it.
[[nodiscard]] Expected<void> check_inside(std::string_view name, const Region& region,
                                          std::uint32_t width, std::uint32_t height);

}  // namespace gazeloop::probe
