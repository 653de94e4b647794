#include "runtime/quality/convolution.h"

#include <algorithm>
#include <cstdint>

namespace gazeloop::quality {
namespace {

void filter_row(const float* from, float* to, std::uint32_t width, const Kernel& kernel) {
    const auto reach = static_cast<std::int64_t>(kernel.size() / 2);
    const auto last = static_cast<std::int64_t>(width) - 1;
    for (std::int64_t x = 0; x <= last; ++x) {
        float sum = 0.0F;
        if (x >= reach && x + reach <= last) {
            const float* const first = from + (x - reach);
            for (std::size_t i = 0; i < kernel.size(); ++i) {
                sum += kernel[i] * first[i];
            }
        } else {
            for (std::int64_t i = -reach; i <= reach; ++i) {
                sum += kernel[static_cast<std::size_t>(i + reach)] *
                       from[std::clamp<std::int64_t>(x + i, 0, last)];
            }
        }
        to[x] = sum;
    }
}

}  // namespace

Plane convolved(const Plane& plane, const Kernel& along_rows, const Kernel& along_columns,
                const RowWork& work) {
    Plane rows(plane.width, plane.height);
    work.over(plane.height, [&](std::uint32_t from, std::uint32_t to) {
        for (std::uint32_t y = from; y < to; ++y) {
            filter_row(plane.row(y), rows.row(y), plane.width, along_rows);
        }
    });
    Plane result(plane.width, plane.height);
    const auto reach = static_cast<std::int64_t>(along_columns.size() / 2);
    const auto last = static_cast<std::int64_t>(plane.height) - 1;
    work.over(plane.height, [&](std::uint32_t from, std::uint32_t to) {
        for (std::uint32_t y = from; y < to; ++y) {
            float* const out = result.row(y);
            for (std::int64_t i = -reach; i <= reach; ++i) {
                const float weight = along_columns[static_cast<std::size_t>(i + reach)];
                const float* const in = rows.row(static_cast<std::uint32_t>(
                    std::clamp<std::int64_t>(static_cast<std::int64_t>(y) + i, 0, last)));
                for (std::uint32_t x = 0; x < plane.width; ++x) {
                    out[x] += weight * in[x];
                }
            }
        }
    });
    return result;
}

}  // namespace gazeloop::quality
