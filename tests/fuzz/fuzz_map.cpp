// Arbitrary parameters: a map is refused with a message, or its tables are finite and monotone and
// its shares lie in [0, 1].

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "runtime/foveation/log_polar/float_map.h"
#include "runtime/foveation/plans/acuity_plan.h"
#include "runtime/foveation/plans/kfr_plan.h"

namespace {

using namespace gazeloop;
using namespace gazeloop::foveation;

void require(bool held) {
    if (!held) {
        std::abort();
    }
}

class Bytes {
  public:
    Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

    template <typename T>
    T take() {
        T value{};
        const std::size_t n = std::min(left_, sizeof value);
        std::memcpy(&value, data_, n);
        data_ += n;
        left_ -= n;
        return value;
    }
    /// Mostly in the range, or else any double.
    double number(double low, double high) {
        if (take<std::uint8_t>() % 8 == 0) {
            return take<double>();
        }
        return low + (high - low) * take<std::uint16_t>() / 65535.0;
    }

  private:
    const std::uint8_t* data_;
    std::size_t left_;
};

/// Where positions can be: pictures, and a few sizes around them. NaN becomes 0.
double bounded(double value) { return std::abs(value) <= 1e6 ? value : 0.0; }

void check(const MapTables& tables, const FloatMap& map, Bytes& bytes) {
    for (std::size_t i = 1; i < tables.forward.size(); ++i) {
        require(tables.forward[i] <= tables.forward[i - 1]);
    }
    const bool rises = tables.column.back() > tables.column.front();
    for (std::size_t i = 1; i < tables.column.size(); ++i) {
        const float step = tables.column[i] - tables.column[i - 1];
        require((rises ? step : -step) >= 0.0F);
    }
    for (int i = 0; i < 8; ++i) {
        const auto x = static_cast<float>(bounded(bytes.number(-4e4, 5e4)));
        const auto y = static_cast<float>(bounded(bytes.number(-4e4, 5e4)));
        const FloatMap::Share share = map.share({x, y});
        require(share.u >= 0.0F && share.u <= 1.0F && share.v >= 0.0F && share.v <= 1.0F);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes(data, size);
    const std::uint8_t kind = bytes.take<std::uint8_t>() % 4;
    const ImageSize image{bytes.take<std::uint16_t>(), bytes.take<std::uint16_t>()};
    if (kind == 3) {
        const gaze::EyeView view{.fov = {bytes.number(-1.6, 0.4), bytes.number(-0.4, 1.6),
                                         bytes.number(-0.4, 1.6), bytes.number(-1.6, 0.4)},
                                 .width_px = image.width_px % 512U,
                                 .height_px = image.height_px % 512U};
        const AcuityParameters parameters{
            .mar = {.slope = bytes.number(0.0, 1.0), .omega0_deg = bytes.number(0.0, 1.0)},
            .pixels_per_degree = bytes.number(0.0, 500.0),
            .lp_width = bytes.take<std::uint8_t>() * 64U,
            .lp_height = bytes.take<std::uint8_t>() * 64U};
        const auto profile = AcuityProfile::create(parameters, view);
        if (!profile) {
            require(profile.error().kind == ErrorKind::Usage && !profile.error().message.empty());
            return 0;
        }
        const glm::dvec3 gaze{bytes.number(-1.0, 1.0), bytes.number(-1.0, 1.0),
                              bytes.number(-1.0, 1.0)};
        LogPolarPlan plan;
        plan_acuity(parameters, *profile, view, gaze, plan);
        require(plan.texels.counts.shaded + plan.texels.counts.off_screen +
                    plan.texels.counts.covered ==
                std::uint64_t{plan.lp.width} * plan.lp.height);
        const MapTables tables = build_map_tables(*profile);
        check(tables, FloatMap(tables, profile->lp(), plan.in_gaze_frame->uniforms), bytes);
        return 0;
    }
    KfrParameters parameters{.sigma = bytes.number(0.0, 33.0),
                             .lp_width = bytes.take<std::uint16_t>(),
                             .lp_height = bytes.take<std::uint16_t>()};
    const gaze::PixelPosition fovea{bounded(bytes.number(-4e4, 5e4)),
                                    bounded(bytes.number(-4e4, 5e4))};
    if (kind == 0) {
        parameters.kernel = bytes.number(0.0, 17.0);
    } else if (kind == 1) {
        parameters.kernel = PrintedPowerKernel{bytes.number(0.0, 17.0)};
    } else {
        std::vector<double> coefficients(bytes.take<std::uint8_t>() % 14U);
        double sum = 0.0;
        for (double& coefficient : coefficients) {
            coefficient = bytes.number(-2.0, 2.0);
            sum += coefficient;
        }
        if (!coefficients.empty()) {
            coefficients.back() += 1.0 - sum;  // or hardly any would be tried
        }
        const auto kernel = PolynomialKernel::create(coefficients);
        if (!kernel) {
            require(kernel.error().kind == ErrorKind::Usage);
            return 0;
        }
        parameters.kernel = *kernel;
    }
    const auto lp = lp_buffer_size(parameters, image);
    if (!lp) {
        require(lp.error().kind == ErrorKind::Usage && !lp.error().message.empty());
        return 0;
    }
    const LogPolarMap map(parameters.kernel, image, fovea);
    const MapTables tables = build_map_tables(parameters.kernel, *lp);
    check(tables, FloatMap(tables, *lp, picture_frame_uniforms(fovea, map.log2_max_radius())),
          bytes);
    LogPolarPlan plan;
    plan_kfr(parameters, *lp, image, fovea, plan);
    require(std::isfinite(plan.disc_radius_px) && plan.disc_radius_px >= 0.0);
    return 0;
}
