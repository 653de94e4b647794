#include "runtime/foveation/log_polar_map.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gazeloop::foveation {
namespace {

constexpr std::uint32_t kMaxSide = 16384;
constexpr double kHoleShare = 0.1;

bool in_range(double value, double least, double greatest) {
    return value >= least && value <= greatest;  // false for NaN
}

Error usage(std::string message) { return {ExitCode::Usage, std::move(message)}; }

double farthest_corner_px(ImageSize image, const gaze::PixelPosition& fovea) {
    const double width = image.width_px;
    const double height = image.height_px;
    return std::hypot(std::max(std::abs(fovea.x_px), std::abs(width - fovea.x_px)),
                      std::max(std::abs(fovea.y_px), std::abs(height - fovea.y_px)));
}

}  // namespace

Expected<LpSize> lp_buffer_size(const KfrParameters& parameters, ImageSize image) {
    if (!in_range(parameters.sigma, KfrParameters::kMinSigma, KfrParameters::kMaxSigma)) {
        return std::unexpected(
            usage(fmt::format("kfr.sigma = {}: must lie in [{}, {}]", parameters.sigma,
                              KfrParameters::kMinSigma, KfrParameters::kMaxSigma)));
    }
    const double alpha = parameters.kernel.alpha;
    if (!in_range(alpha, PowerKernel::kMinAlpha, PowerKernel::kMaxAlpha)) {
        return std::unexpected(usage(fmt::format("kfr.alpha = {}: must lie in [{}, {}]", alpha,
                                                 PowerKernel::kMinAlpha, PowerKernel::kMaxAlpha)));
    }
    if (!in_range(parameters.border_px, 0.0, 64.0)) {
        return std::unexpected(
            usage(fmt::format("kfr.border_px = {}: must lie in [0, 64]", parameters.border_px)));
    }
    if (image.width_px < 2 || image.height_px < 2 || image.width_px > kMaxSide ||
        image.height_px > kMaxSide) {
        return std::unexpected(
            usage(fmt::format("a picture of {}x{} px cannot be foveated: each side must have 2 to "
                              "{} px",
                              image.width_px, image.height_px, kMaxSide)));
    }
    const auto side = [&](std::uint32_t pixels) {
        return static_cast<std::uint32_t>(std::lround(pixels / parameters.sigma));
    };
    const LpSize size{side(image.width_px), side(image.height_px)};
    if (size.width < 2 || size.height < 4 || size.width > kMaxSide || size.height > kMaxSide) {
        return std::unexpected(usage(
            fmt::format("kfr.sigma = {} makes an LP-buffer of {}x{} texels from {}x{} px: it must "
                        "have 2x4 to {}x{}; choose another sigma",
                        parameters.sigma, size.width, size.height, image.width_px, image.height_px,
                        kMaxSide, kMaxSide)));
    }
    return size;
}

LogPolarMap::LogPolarMap(const PowerKernel& kernel, ImageSize image,
                         const gaze::PixelPosition& fovea)
    : kernel_(kernel),
      max_radius_px_(farthest_corner_px(image, fovea)),
      log_max_radius_(std::log(max_radius_px_)) {}

double LogPolarMap::u(double radius_px) const {
    if (radius_px <= 1.0) {
        return 0.0;
    }
    return kernel_(std::log(radius_px) / log_max_radius_);
}

double LogPolarMap::radius_px(double u) const {
    return std::exp(log_max_radius_ * kernel_.inverse(std::max(u, 0.0)));
}

double LogPolarMap::log2_max_radius() const { return std::log2(max_radius_px_); }

double LogPolarMap::texels_per_pixel(double radius_px, LpSize lp) const {
    if (radius_px <= 1.0) {
        return 0.0;
    }
    const double x = std::log(radius_px) / log_max_radius_;
    const double radial = lp.width * kernel_.derivative(x) / (log_max_radius_ * radius_px);
    const double tangential = lp.height / (2.0 * std::numbers::pi * radius_px);
    return radial * tangential;
}

double LogPolarMap::disc_radius_px(LpSize lp) const {
    // The density rises from the hole to one peak and falls from there on: its logarithm's
    // derivative, (alpha - 1) / x - 2 L, changes sign once, at x = (alpha - 1) / (2 L).
    const double peak_log = std::clamp((kernel_.alpha - 1.0) / 2.0, 0.0, log_max_radius_);
    double low = std::max(peak_log, 1e-9);
    double high = log_max_radius_;
    const auto offers_texel = [&](double log_radius) {
        return texels_per_pixel(std::exp(log_radius), lp) >= 1.0;
    };
    if (!offers_texel(low)) {
        const double affordable = std::sqrt(kHoleShare * lp.width * lp.height / std::numbers::pi);
        return peak_log > 0.0 ? std::min(std::exp(peak_log), affordable) : 0.0;
    }
    if (offers_texel(high)) {
        return max_radius_px_;
    }
    while (high - low > 1e-6) {
        const double middle = 0.5 * (low + high);
        (offers_texel(middle) ? low : high) = middle;
    }
    return std::exp(low);
}

}  // namespace gazeloop::foveation
