#include "runtime/report/page/distribution.h"

#include <algorithm>
#include <array>
#include <optional>

namespace gazeloop::report::page {
namespace {

constexpr std::int64_t kBins = 60;

/// The least of 1, 2, 5, 10, 20 ... that takes at most kBins for the range.
std::int64_t nice_width(__int128 range) {
    constexpr __int128 kMost = 5'000'000'000'000'000'000;
    __int128 decade = 1;
    for (;; decade *= 10) {
        for (const int times : {1, 2, 5}) {
            const __int128 width = decade * times;
            if (width * kBins >= range || width >= kMost) {
                return static_cast<std::int64_t>(width);
            }
        }
    }
}

struct Range {
    std::int64_t least = 0;
    std::int64_t greatest = 0;
};

std::optional<Range> range_of(std::span<const DurationColumn* const> columns) {
    constexpr std::array kNearlyAll{99.9};
    std::optional<Range> range;
    for (const DurationColumn* const column : columns) {
        if (column->known() == 0) {
            continue;
        }
        const std::int64_t least = *column->least();
        const std::int64_t greatest =
            column->percentiles(kNearlyAll).front().value_or(*column->greatest());
        range = range ? Range{std::min(range->least, least), std::max(range->greatest, greatest)}
                      : Range{least, greatest};
    }
    return range;
}

std::int64_t floor_to(std::int64_t number, std::int64_t width) {
    const std::int64_t rest = number % width;
    const std::int64_t down = rest < 0 ? rest + width : rest;
    return static_cast<std::int64_t>(
        std::max<__int128>(static_cast<__int128>(number) - down, INT64_MIN));
}

}  // namespace

std::vector<Distribution> distributions(std::span<const DurationColumn* const> columns) {
    std::vector<Distribution> result(columns.size());
    const std::optional<Range> range = range_of(columns);
    if (!range) {
        return result;
    }
    const std::int64_t width = nice_width(static_cast<__int128>(range->greatest) - range->least);
    const std::int64_t first = floor_to(range->least, width);
    const auto bin_of = [&](std::int64_t number) {
        return (static_cast<__int128>(number) - first) / width;
    };
    const auto bins = static_cast<std::size_t>(bin_of(range->greatest)) + 1;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const DurationColumn& column = *columns[i];
        Distribution& distribution = result[i];
        distribution = {.first = first,
                        .width = width,
                        .frames = std::vector<std::uint64_t>(bins),
                        .above = 0,
                        .known = column.known()};
        for (std::size_t row = 0; row < column.size(); ++row) {
            const std::optional<std::int64_t> number = column.at(row);
            if (!number) {
                continue;
            }
            const __int128 bin = bin_of(*number);
            if (bin < static_cast<__int128>(bins)) {
                ++distribution.frames[static_cast<std::size_t>(bin)];
            } else {
                ++distribution.above;
            }
        }
    }
    return result;
}

}  // namespace gazeloop::report::page
