#include "runtime/foveation/log_polar/log_polar_map.h"
#include "runtime/foveation/picture/angles.h"
#include "runtime/foveation/picture/hidden_area.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "runtime/foveation/picture/screen_wedge.h"

namespace gazeloop::foveation {
namespace {

constexpr double kHoleShare = 0.1;
/// Steps over x = ln r / L in which changes of density are looked for.
constexpr int kSearchSteps = 256;

bool in_range(double value, double least, double greatest) {
    return value >= least && value <= greatest;  // false for NaN
}

Error usage(std::string message) { return {ErrorKind::Usage, std::move(message)}; }

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
    if (auto good = parameters.kernel.check(); !good) {
        return std::unexpected(good.error());
    }
    if (!in_range(parameters.border_px, 0.0, 64.0)) {
        return std::unexpected(
            usage(fmt::format("kfr.border_px = {}: must lie in [0, 64]", parameters.border_px)));
    }
    if (image.width_px < 2 || image.height_px < 2 || image.width_px > LpSize::kMaxSide ||
        image.height_px > LpSize::kMaxSide) {
        return std::unexpected(
            usage(fmt::format("a picture of {}x{} px cannot be foveated: each side must have 2 to "
                              "{} px",
                              image.width_px, image.height_px, LpSize::kMaxSide)));
    }
    if (!in_range(parameters.aspect, 0.0, KfrParameters::kMaxAspect)) {
        return std::unexpected(usage(fmt::format("kfr.aspect = {}: must lie in [0, {}]",
                                                 parameters.aspect, KfrParameters::kMaxAspect)));
    }
    double width = image.width_px / parameters.sigma;
    double height = image.height_px / parameters.sigma;
    if (parameters.aspect > 0.0) {
        const double texels = width * height;
        // No further than what is refused below.
        constexpr double kTooLong = 2.0 * LpSize::kMaxSide;
        width = std::min(std::sqrt(texels * parameters.aspect), kTooLong);
        height = std::min(std::sqrt(texels / parameters.aspect), kTooLong);
    }
    const auto side = [](std::uint32_t stated, double texels) {
        return stated != 0 ? stated : static_cast<std::uint32_t>(std::lround(texels));
    };
    const LpSize size{side(parameters.lp_width, width), side(parameters.lp_height, height)};
    if (!size.in_range()) {
        return std::unexpected(usage(fmt::format(
            "kfr.sigma = {}, kfr.lp_width = {} and kfr.lp_height = {} make an LP-buffer of {}x{} "
            "texels from {}x{} px: it must have {}x{} to {}x{}; choose others",
            parameters.sigma, parameters.lp_width, parameters.lp_height, size.width, size.height,
            image.width_px, image.height_px, LpSize::kMinWidth, LpSize::kMinHeight,
            LpSize::kMaxSide, LpSize::kMaxSide)));
    }
    return size;
}

LogPolarMap::LogPolarMap(RadialKernel kernel, ImageSize image, const gaze::PixelPosition& fovea)
    : kernel_(std::move(kernel)),
      image_(image),
      fovea_(fovea),
      max_radius_px_(farthest_corner_px(image, fovea)),
      log_max_radius_(std::log(max_radius_px_)) {}

double LogPolarMap::u(double radius_px) const {
    if (radius_px <= 1.0) {
        return 0.0;
    }
    return kernel_(std::min(std::log(radius_px) / log_max_radius_, 1.0));
}

double LogPolarMap::radius_px(double u) const {
    return std::exp(log_max_radius_ * kernel_.inverse(std::clamp(u, 0.0, 1.0)));
}

double LogPolarMap::log2_max_radius() const { return std::log2(max_radius_px_); }

LpShare LogPolarMap::share(const gaze::PixelPosition& position) const {
    const double dx = position.x_px - fovea_.x_px;
    const double dy = position.y_px - fovea_.y_px;
    double turns = std::atan2(dy, dx) / kTurn;
    turns = turns < 0.0 ? turns + 1.0 : turns;
    return {u(std::hypot(dx, dy)), turns < 1.0 ? turns : 0.0};
}

std::optional<gaze::PixelPosition> LogPolarMap::position(const LpShare& share) const {
    const double radius = radius_px(share.u);
    return gaze::PixelPosition{fovea_.x_px + radius * std::cos(share.v * kTurn),
                               fovea_.y_px + radius * std::sin(share.v * kTurn)};
}

std::optional<ColumnRange> LogPolarMap::on_screen(double from_rad, double to_rad) const {
    const auto radii = screen_radii_in_wedge(image_, fovea_, from_rad, to_rad);
    if (!radii) {
        return std::nullopt;
    }
    return ColumnRange{u(radii->min_px), u(radii->max_px)};
}

std::optional<ColumnRange> LogPolarMap::visible(const HiddenArea& hidden, double from_rad,
                                                double to_rad) const {
    const auto radii = radii_in_wedge(hidden.outline(), fovea_, from_rad, to_rad);
    if (!radii) {
        return std::nullopt;
    }
    return ColumnRange{u(radii->min_px), u(radii->max_px)};
}

Density LogPolarMap::density(const gaze::PixelPosition& position, LpSize lp) const {
    return density(std::hypot(position.x_px - fovea_.x_px, position.y_px - fovea_.y_px), lp);
}

Density LogPolarMap::density(double radius_px, LpSize lp) const {
    if (radius_px <= 1.0) {
        return {};
    }
    const double x = std::log(radius_px) / log_max_radius_;
    return {lp.width * kernel_.derivative(std::min(x, 1.0)) / (log_max_radius_ * radius_px),
            lp.height / (kTurn * radius_px)};
}

double LogPolarMap::texels_per_pixel(double radius_px, LpSize lp) const {
    const Density at = density(radius_px, lp);
    return at.radial * at.tangential;
}

double LogPolarMap::affordable_radius_px(LpSize lp) const {
    return std::sqrt(kHoleShare * lp.width * lp.height / std::numbers::pi);
}

/// The radius at which the condition changes, between x at which it holds and x at which it does
/// not.
template <typename Condition>
double LogPolarMap::change_between(double holds_at, double fails_at,
                                   const Condition& condition) const {
    while (std::abs(fails_at - holds_at) * log_max_radius_ > 1e-6) {
        const double middle = 0.5 * (holds_at + fails_at);
        (condition(std::exp(middle * log_max_radius_)) ? holds_at : fails_at) = middle;
    }
    return std::exp(holds_at * log_max_radius_);
}

/// The radius at which a function of the radius is greatest. x = ln r / L is searched in steps,
/// then by golden sections around the best step.
template <typename Function>
double LogPolarMap::peak(const Function& function) const {
    const auto at = [&](double x) { return function(std::exp(x * log_max_radius_)); };
    int best = 0;
    double greatest = -1.0;
    for (int i = 0; i <= kSearchSteps; ++i) {
        const double value = at(std::max(static_cast<double>(i) / kSearchSteps, 1e-9));
        if (value > greatest) {
            greatest = value;
            best = i;
        }
    }
    double low = std::max(best - 1, 0) / static_cast<double>(kSearchSteps);
    double high = std::min(best + 1, kSearchSteps) / static_cast<double>(kSearchSteps);
    constexpr double kSection = std::numbers::phi - 1.0;
    for (int i = 0; i < 40; ++i) {
        const double left = high - kSection * (high - low);
        const double right = low + kSection * (high - low);
        (at(left) < at(right) ? low : high) = at(left) < at(right) ? left : right;
    }
    return std::exp(0.5 * (low + high) * log_max_radius_);
}

double LogPolarMap::disc_radius_px(LpSize lp) const {
    const auto offers_texel = [&](double radius_px) {
        return texels_per_pixel(radius_px, lp) >= 1.0;
    };
    // A kernel's density may rise and fall more than once. Each fall below one texel per pixel is a
    // candidate; so is the screen's end, if the density has not fallen before it.
    double best_radius = 0.0;
    double best_gain = 0.0;
    const auto consider = [&](double radius_px) {
        const double gain =
            u(radius_px) * lp.width * lp.height - std::numbers::pi * radius_px * radius_px;
        if (best_radius == 0.0 || gain > best_gain) {
            best_radius = radius_px;
            best_gain = gain;
        }
    };
    double before = 1e-9;
    bool offered = offers_texel(std::exp(before * log_max_radius_));
    for (int i = 1; i <= kSearchSteps; ++i) {
        const double x = static_cast<double>(i) / kSearchSteps;
        const bool offers =
            offers_texel(i == kSearchSteps ? max_radius_px_ : std::exp(x * log_max_radius_));
        if (offered && !offers) {
            consider(change_between(before, x, offers_texel));
        }
        before = x;
        offered = offers;
    }
    if (offered) {
        consider(max_radius_px_);
    }
    if (best_radius > 0.0) {
        return best_radius;
    }
    const double hole = peak([&](double radius_px) { return texels_per_pixel(radius_px, lp); });
    // A density that falls all the way from the first pixel has no hole.
    return hole > 1.001 ? std::min(hole, affordable_radius_px(lp)) : 0.0;
}

double LogPolarMap::hole_radius_px(LpSize lp) const {
    const auto radial = [&](double radius_px) { return density(radius_px, lp).radial; };
    double before = 1e-9;
    if (radial(std::exp(before * log_max_radius_)) >= 1.0) {
        return 0.0;
    }
    for (int i = 1; i <= kSearchSteps; ++i) {
        const double x = static_cast<double>(i) / kSearchSteps;
        if (radial(std::exp(x * log_max_radius_)) >= 1.0) {
            return change_between(before, x,
                                  [&](double radius_px) { return radial(radius_px) < 1.0; });
        }
        before = x;
    }
    const double hole = peak(radial);
    return hole > 1.001 ? std::min(hole, affordable_radius_px(lp)) : 0.0;
}

}  // namespace gazeloop::foveation
