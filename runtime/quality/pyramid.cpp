#include "runtime/quality/pyramid.h"

#include <algorithm>
#include <vector>

namespace gazeloop::quality {
namespace {

constexpr float kCentre = 0.4F;
constexpr float kNear = 0.25F;
constexpr float kFar = 0.05F;

}  // namespace

void reduce(const Plane& level, const RowWork& work, Plane& next) {
    const std::uint32_t width = halved(level.width);
    const std::uint32_t height = halved(level.height);
    next.resize(width, height);
    const auto row_of = [&](std::int64_t y) {
        return level.row(static_cast<std::uint32_t>(
            std::clamp<std::int64_t>(y, 0, static_cast<std::int64_t>(level.height) - 1)));
    };
    work.over(height, [&](std::uint32_t from, std::uint32_t to) {
        // With what the filter reads beyond the row's ends.
        constexpr std::size_t kMargin = 2;
        std::vector<float> padded(level.width + 2 * kMargin + 1);
        float* const column = padded.data() + kMargin;
        for (std::uint32_t y = from; y < to; ++y) {
            const std::int64_t middle = 2 * static_cast<std::int64_t>(y);
            const float* const a = row_of(middle - 2);
            const float* const b = row_of(middle - 1);
            const float* const c = row_of(middle);
            const float* const d = row_of(middle + 1);
            const float* const e = row_of(middle + 2);
            for (std::uint32_t x = 0; x < level.width; ++x) {
                column[x] = kCentre * c[x] + kNear * (b[x] + d[x]) + kFar * (a[x] + e[x]);
            }
            std::fill(padded.begin(), padded.begin() + kMargin, column[0]);
            std::fill(padded.begin() + kMargin + level.width, padded.end(),
                      column[level.width - 1]);
            float* const out = next.row(y);
            for (std::uint32_t x = 0; x < width; ++x) {
                const float* const at = padded.data() + 2 * std::size_t{x};
                out[x] = kCentre * at[2] + kNear * (at[1] + at[3]) + kFar * (at[0] + at[4]);
            }
        }
    });
}

void expand_row(const Plane& next, std::uint32_t y, std::uint32_t width, float* scratch,
                float* row) {
    const std::uint32_t middle = y / 2;
    const float* const here = next.row(middle);
    const float* const below = next.row(std::min(middle + 1, next.height - 1));
    if (y % 2 == 0) {
        const float* const above = next.row(middle == 0 ? 0 : middle - 1);
        for (std::uint32_t x = 0; x < next.width; ++x) {
            scratch[x] = 2.0F * kCentre * here[x] + 2.0F * kFar * (above[x] + below[x]);
        }
    } else {
        for (std::uint32_t x = 0; x < next.width; ++x) {
            scratch[x] = 2.0F * kNear * (here[x] + below[x]);
        }
    }
    const std::uint32_t last = next.width - 1;
    const auto even = [&](std::uint32_t x, float left, float right) {
        row[2 * std::size_t{x}] = 2.0F * kCentre * scratch[x] + 2.0F * kFar * (left + right);
    };
    even(0, scratch[0], scratch[std::min(1U, last)]);
    for (std::uint32_t x = 1; x < last; ++x) {
        even(x, scratch[x - 1], scratch[x + 1]);
    }
    if (last > 0) {
        even(last, scratch[last - 1], scratch[last]);
    }
    for (std::uint32_t x = 0; x < width / 2; ++x) {
        row[2 * std::size_t{x} + 1] = 2.0F * kNear * (scratch[x] + scratch[std::min(x + 1, last)]);
    }
}

}  // namespace gazeloop::quality
