#include "runtime/numerics/random_draws.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "runtime/foveation/log_polar/acuity_map.h"
#include "runtime/foveation/log_polar/float_map.h"

namespace gazeloop::numerics {
namespace {

using foveation::FloatMap;
using foveation::LpSize;
using foveation::MapTables;
using foveation::MarLine;

constexpr std::uint64_t kDrawsPerMap = 10'000;

class Draws {
  public:
    explicit Draws(std::uint64_t seed) : random_(seed) {}

    /// One random map, asked `draws` times; false: the parameters make none.
    bool one_map(std::uint64_t draws, DrawCounts& counts) {
        image_ = {side(), side()};
        return whole(0, 4) == 0 ? gaze_frame(draws, counts) : picture_frame(draws, counts);
    }

  private:
    double even(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    double scaled(double low, double high) { return std::exp(even(std::log(low), std::log(high))); }
    std::uint32_t whole(std::uint32_t low, std::uint32_t high) {
        return std::uniform_int_distribution<std::uint32_t>(low, high)(random_);
    }
    std::uint32_t side() { return static_cast<std::uint32_t>(std::lround(scaled(2.0, 16384.0))); }

    foveation::RadialKernel kernel() {
        using foveation::PowerKernel;
        const double alpha = scaled(PowerKernel::kMinAlpha, PowerKernel::kMaxAlpha);
        switch (whole(0, 5)) {
            case 0: {
                // Coefficients that are not negative never fall.
                std::vector<double> coefficients(whole(1, 12));
                double sum = 0.0;
                for (double& coefficient : coefficients) {
                    coefficient = scaled(1e-6, 1.0);
                    sum += coefficient;
                }
                for (double& coefficient : coefficients) {
                    coefficient /= sum;
                }
                return value_or_throw(foveation::PolynomialKernel::create(coefficients));
            }
            case 1:
                return foveation::RadialKernel(foveation::SineKernel{});
            case 2:
                return foveation::RadialKernel(foveation::ExponentialKernel{});
            case 3:
                return foveation::RadialKernel(foveation::PrintedPowerKernel{alpha});
            case 4: {
                const double x = even(1e-6, 1.0 - 1e-6);
                const double y = even(1e-6, 1.0 - 1e-6);
                const std::vector<foveation::TableKernel::Sample> samples{{0, 0}, {x, y}, {1, 1}};
                return foveation::TableKernel::create(samples).value();
            }
            default:
                return foveation::RadialKernel(alpha);
        }
    }

    bool picture_frame(std::uint64_t draws, DrawCounts& counts) {
        const foveation::KfrParameters parameters{.sigma = scaled(0.5, 32.0), .kernel = kernel()};
        const auto lp = foveation::lp_buffer_size(parameters, image_);
        if (!lp) {
            return false;
        }
        fovea_ = {even(-2.0, 3.0) * image_.width_px, even(-2.0, 3.0) * image_.height_px};
        const foveation::LogPolarMap map(parameters.kernel, image_, fovea_);
        const MapTables tables = foveation::build_map_tables(parameters.kernel, *lp);
        ask(FloatMap(tables, *lp, foveation::picture_frame_uniforms(fovea_, map.log2_max_radius())),
            *lp, false, draws, counts);
        return true;
    }

    bool gaze_frame(std::uint64_t draws, DrawCounts& counts) {
        const auto edge = [&] { return even(0.02, 0.495 * std::numbers::pi); };
        const gaze::EyeView view{.fov = {-edge(), edge(), edge(), -edge()},
                                 .width_px = image_.width_px,
                                 .height_px = image_.height_px};
        const auto profile = foveation::AcuityProfile::create(
            {.mar = {.slope = scaled(MarLine::kMinSlope, MarLine::kMaxSlope),
                     .omega0_deg = scaled(MarLine::kMinOmega0Deg, MarLine::kMaxOmega0Deg)}},
            view);
        if (!profile) {
            return false;
        }
        const foveation::GazeFrame frame(view, {even(-1.0, 1.0), even(-1.0, 1.0), even(-1.0, 1.0)});
        const MapTables tables = foveation::build_map_tables(*profile);
        fovea_ = {even(0.0, image_.width_px), even(0.0, image_.height_px)};
        ask(FloatMap(tables, profile->lp(), foveation::gaze_frame_uniforms(frame)), profile->lp(),
            true, draws, counts);
        return true;
    }

    /// On the picture, near the fovea down to no distance at all, on an axis, or far outside.
    glm::vec2 position() {
        const double width = image_.width_px;
        const double height = image_.height_px;
        const auto fovea = glm::vec2(glm::dvec2(fovea_.x_px, fovea_.y_px));
        switch (whole(0, 5)) {
            case 0:
                return glm::vec2(glm::dvec2(even(-4.0, 5.0) * width, even(-4.0, 5.0) * height));
            case 1: {
                const double r = scaled(1e-30, 1.0);
                return fovea + glm::vec2(glm::dvec2(r * even(-1.0, 1.0), r * even(-1.0, 1.0)));
            }
            case 2:
                return {fovea.x + static_cast<float>(even(-width, width)),
                        std::nextafter(fovea.y, whole(0, 1) == 0 ? -1e9F : 1e9F)};
            case 3:
                return {whole(0, 1) == 0 ? fovea.x : static_cast<float>(even(0, width)), fovea.y};
            default:
                return {std::floor(static_cast<float>(even(0, width))) + 0.5F,
                        std::floor(static_cast<float>(even(0, height))) + 0.5F};
        }
    }

    void ask(const FloatMap& map, LpSize lp, bool rays, std::uint64_t draws, DrawCounts& counts) {
        for (std::uint64_t i = 0; i < draws; ++i) {
            const FloatMap::Share share = map.share(position());
            const std::uint32_t column = whole(0, lp.width - 1);
            const std::uint32_t row = whole(0, lp.height - 1);
            const glm::vec3 place =
                rays ? map.view_ray(column, row) : glm::vec3(map.position(column, row), 0.0F);
            counts.not_finite +=
                std::isfinite(share.u + share.v + place.x + place.y + place.z) ? 0 : 1;
            counts.outside +=
                share.u >= 0.0F && share.u <= 1.0F && share.v >= 0.0F && share.v <= 1.0F ? 0 : 1;
        }
        counts.draws += draws;
    }

    std::mt19937_64 random_;
    foveation::ImageSize image_;
    gaze::PixelPosition fovea_;
};

}  // namespace

DrawCounts draw_extremes(std::uint64_t draws, std::uint64_t seed) {
    Draws source(seed);
    DrawCounts counts;
    while (counts.draws < draws) {
        source.one_map(std::min(kDrawsPerMap, draws - counts.draws), counts);
    }
    return counts;
}

}  // namespace gazeloop::numerics
