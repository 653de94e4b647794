#include "runtime/probe/region.h"

#include <fmt/core.h>

#include <array>
#include <charconv>

namespace gazeloop::probe {

Expected<Region> parse_region(std::string_view name, std::string_view text) {
    const auto refuse = [&](std::string_view why) {
        return std::unexpected(
            Error{ErrorKind::Usage, fmt::format("--{} {}: {}; X,Y,W,H is expected, in pixels of a "
                                                "frame, from its upper left corner",
                                                name, text, why)});
    };
    std::array<std::uint32_t, 4> numbers{};
    const char* at = text.data();
    const char* const end = text.data() + text.size();
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto [stopped, error] = std::from_chars(at, end, numbers[i]);
        const bool last = i + 1 == numbers.size();
        if (error != std::errc{} || (last ? stopped != end : stopped == end || *stopped != ',')) {
            return refuse("these are not four whole numbers");
        }
        at = stopped + (last ? 0 : 1);
    }
    const Region region{numbers[0], numbers[1], numbers[2], numbers[3]};
    if (region.width == 0 || region.height == 0) {
        return refuse("the region is empty");
    }
    return region;
}

Expected<void> check_regions_apart(const Region& lamp, const Region& patch) {
    const auto apart = [](std::uint64_t a, std::uint64_t a_size, std::uint64_t b,
                          std::uint64_t b_size) { return a + a_size <= b || b + b_size <= a; };
    if (apart(lamp.x, lamp.width, patch.x, patch.width) ||
        apart(lamp.y, lamp.height, patch.y, patch.height)) {
        return {};
    }
    return std::unexpected(
        Error{ErrorKind::Usage,
              fmt::format("--lamp {},{},{},{} and --patch {},{},{},{} overlap: what both show "
                          "would seem to come at once; mark two regions that share no pixel",
                          lamp.x, lamp.y, lamp.width, lamp.height, patch.x, patch.y, patch.width,
                          patch.height)});
}

Expected<void> check_inside(std::string_view name, const Region& region, std::uint32_t width,
                            std::uint32_t height) {
    if (std::uint64_t{region.x} + region.width <= width &&
        std::uint64_t{region.y} + region.height <= height) {
        return {};
    }
    return std::unexpected(
        Error{ErrorKind::Usage,
              fmt::format("--{} {},{},{},{}: reaches out of the frames, which are {}x{} pixels",
                          name, region.x, region.y, region.width, region.height, width, height)});
}

}  // namespace gazeloop::probe
