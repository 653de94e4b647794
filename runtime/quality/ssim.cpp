#include "runtime/quality/ssim.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "runtime/quality/encoded_colour.h"

namespace gazeloop::quality {
namespace {

constexpr double kC1 = 0.01 * 0.01;
constexpr double kC2 = 0.03 * 0.03;
constexpr std::uint32_t kReach = kSsimWindow_px / 2;

using Window = std::array<double, kSsimWindow_px>;

Window gaussian_window() {
    constexpr double kSigma = 1.5;
    Window window{};
    double sum = 0.0;
    for (std::size_t i = 0; i < window.size(); ++i) {
        const double x = static_cast<double>(i) - kReach;
        window[i] = std::exp(-x * x / (2.0 * kSigma * kSigma));
        sum += window[i];
    }
    for (double& value : window) {
        value /= sum;
    }
    return window;
}

Plane luma(const render::LinearPicture& picture, const RowWork& work) {
    const auto channels = encoded_channels(picture, work);
    Plane plane(picture.width, picture.height);
    for (std::size_t at = 0; at < plane.values.size(); ++at) {
        plane.values[at] = 0.2126F * channels[0].values[at] + 0.7152F * channels[1].values[at] +
                           0.0722F * channels[2].values[at];
    }
    return plane;
}

/// Of two pictures within a window: means, squares and product.
struct Moments {
    double a = 0.0;
    double b = 0.0;
    double aa = 0.0;
    double bb = 0.0;
    double ab = 0.0;

    void add(double weight, const Moments& other) {
        a += weight * other.a;
        b += weight * other.b;
        aa += weight * other.aa;
        bb += weight * other.bb;
        ab += weight * other.ab;
    }
    [[nodiscard]] double similarity() const {
        const double variances = std::max(aa - a * a, 0.0) + std::max(bb - b * b, 0.0);
        return (2.0 * a * b + kC1) * (2.0 * (ab - a * b) + kC2) /
               ((a * a + b * b + kC1) * (variances + kC2));
    }
};

}  // namespace

Expected<Plane> ssim_map(const render::LinearPicture& reference, const render::LinearPicture& test,
                         const RowWork& work) {
    const std::uint32_t width = reference.width;
    const std::uint32_t height = reference.height;
    if (std::min(width, height) < kSsimWindow_px) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("SSIM: the pictures have {}x{} px, and its window {}x{}", width,
                              height, kSsimWindow_px, kSsimWindow_px)});
    }
    const Window window = gaussian_window();
    const Plane a = luma(reference, work);
    const Plane b = luma(test, work);
    Plane map(width - 2 * kReach, height - 2 * kReach);
    work.over(map.height, [&](std::uint32_t from, std::uint32_t to) {
        std::vector<Moments> columns(width);
        for (std::uint32_t top = from; top < to; ++top) {
            std::ranges::fill(columns, Moments{});
            for (std::uint32_t i = 0; i < kSsimWindow_px; ++i) {
                const float* const row_a = a.row(top + i);
                const float* const row_b = b.row(top + i);
                for (std::uint32_t x = 0; x < width; ++x) {
                    const double va = static_cast<double>(row_a[x]);
                    const double vb = static_cast<double>(row_b[x]);
                    columns[x].add(window[i], {va, vb, va * va, vb * vb, va * vb});
                }
            }
            float* const row = map.row(top);
            for (std::uint32_t x = 0; x < map.width; ++x) {
                Moments moments;
                for (std::uint32_t i = 0; i < kSsimWindow_px; ++i) {
                    moments.add(window[i], columns[x + i]);
                }
                row[x] = static_cast<float>(moments.similarity());
            }
        }
    });
    return map;
}

double mean_ssim(const Plane& map, const Plane& weights) {
    double similarity = 0.0;
    double total = 0.0;
    for (std::uint32_t y = 0; y < map.height; ++y) {
        const float* const row = map.row(y);
        const float* const weight = weights.row(y + kReach) + kReach;
        for (std::uint32_t x = 0; x < map.width; ++x) {
            similarity += static_cast<double>(weight[x]) * static_cast<double>(row[x]);
            total += static_cast<double>(weight[x]);
        }
    }
    return similarity / total;
}

}  // namespace gazeloop::quality
