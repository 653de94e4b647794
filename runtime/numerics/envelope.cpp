#include "runtime/numerics/envelope.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "runtime/numerics/errors.h"
#include "runtime/numerics/random_draws.h"

namespace gazeloop::numerics {
namespace {

using foveation::AcuityProfile;
using foveation::ImageSize;
using foveation::LogPolarMap;
using foveation::LpSize;
using foveation::RadialKernel;
using gaze::PixelPosition;

constexpr std::size_t kPositions = 600;
constexpr std::uint64_t kDraws = 10'000'000;
constexpr std::uint64_t kQuickDraws = 200'000;
/// A first column that reaches farther than this, or a last one of a larger share of the farthest
/// radius, is a fault of the parameters that no arithmetic mends.
constexpr double kWidestFirstPx = 32.0;
constexpr double kWidestLastShare = 0.25;

struct NamedFovea {
    const char* name;
    double x;  ///< in picture sizes
    double y;
    bool on_screen;
};
constexpr std::array kFoveae{
    NamedFovea{"centre", 0.5, 0.5, true},        NamedFovea{"a third", 0.3333, 0.2, true},
    NamedFovea{"edge", 0.0, 0.5, true},          NamedFovea{"corner", 1.0, 1.0, true},
    NamedFovea{"1 size left", -1.0, 0.5, false}, NamedFovea{"2 sizes off", 3.0, -2.0, false}};

struct NamedKernel {
    std::string name;
    RadialKernel kernel;
};

std::vector<NamedKernel> kernels(bool quick) {
    std::vector<NamedKernel> list;
    const std::vector<double> alphas =
        quick ? std::vector{0.5, 4.0} : std::vector{0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0};
    for (const double alpha : alphas) {
        list.push_back({fmt::format("B {}", alpha), alpha});
    }
    const std::vector<double> printed = quick ? std::vector{4.0} : std::vector{1.0, 4.0, 16.0};
    for (const double alpha : printed) {
        list.push_back({fmt::format("A {}", alpha), foveation::PrintedPowerKernel{alpha}});
    }
    using Coefficients = std::vector<double>;
    for (const Coefficients& coefficients :
         {Coefficients{0.25, 0.25, 0.5}, Coefficients{0.0, 3.0, -2.0}}) {
        list.push_back(
            {fmt::format("polynomial {},{},{}", coefficients[0], coefficients[1], coefficients[2]),
             value_or_throw(foveation::PolynomialKernel::create(coefficients))});
    }
    list.push_back({"sin", RadialKernel(foveation::SineKernel{})});
    list.push_back({"exp", RadialKernel(foveation::ExponentialKernel{})});
    const std::vector<foveation::TableKernel::Sample> samples{
        {0, 0}, {0.4, 0.05}, {0.7, 0.3}, {1, 1}};
    list.push_back({"table of 4", foveation::TableKernel::create(samples).value()});
    return list;
}

/// Asymmetric, as headsets are.
gaze::EyeView headset_view(ImageSize image) {
    constexpr double kDegree = std::numbers::pi / 180.0;
    return {.fov = {-52.0 * kDegree, 48.0 * kDegree, 50.0 * kDegree, -50.0 * kDegree},
            .width_px = image.width_px,
            .height_px = image.height_px};
}

std::string why_useless(const RadialKernel& kernel, LpSize lp, ImageSize image,
                        const PixelPosition& fovea) {
    const LogPolarMap map(kernel, image, fovea);
    const double first = map.radius_px(1.0 / lp.width);
    const double last = map.max_radius_px() - map.radius_px(1.0 - 1.0 / lp.width);
    if (first > kWidestFirstPx) {
        return fmt::format("the first column reaches {:.0f} px from the fovea", first);
    }
    if (last > kWidestLastShare * map.max_radius_px()) {
        return fmt::format("the last column is {:.0f} px wide", last);
    }
    return "";
}

class Measurement {
  public:
    Measurement(const render::VulkanContext& context, const EnvelopeOptions& options)
        : context_(context), options_(options), probe_(context), random_(options.seed) {}

    void picture_frame(const NamedKernel& named, ImageSize image, double sigma) {
        const auto lp = lp_buffer_size({.sigma = sigma, .kernel = named.kernel}, image);
        if (!lp) {
            return;  // more texels than a device holds
        }
        const auto family = std::make_shared<const MapFamily>(
            MapFamily{build_map_tables(named.kernel, *lp), foveation::MapError(named.kernel)});
        const render::MapBuffers buffers(context_, family->tables);
        for (const NamedFovea& at : kFoveae) {
            const PixelPosition fovea{at.x * image.width_px, at.y * image.height_px};
            measure(MapUnderTest(family, named.kernel, *lp, image, fovea), buffers,
                    {.map = named.name,
                     .image = image,
                     .sigma = sigma,
                     .lp = *lp,
                     .fovea = at.name,
                     .on_screen = at.on_screen,
                     .useless = why_useless(named.kernel, *lp, image, fovea)});
        }
    }

    void gaze_frame(double slope, ImageSize image) {
        const gaze::EyeView view = headset_view(image);
        const AcuityProfile profile =
            value_or_throw(AcuityProfile::create({.mar = {.slope = slope}}, view));
        const auto family = std::make_shared<const MapFamily>(
            MapFamily{build_map_tables(profile), foveation::MapError(profile)});
        const render::MapBuffers buffers(context_, family->tables);
        for (const NamedFovea& at : kFoveae) {
            measure(MapUnderTest(family, profile, view,
                                 {at.x * image.width_px, at.y * image.height_px}),
                    buffers,
                    {.map = fmt::format("acuity m={}", slope),
                     .image = image,
                     .lp = profile.lp(),
                     .fovea = at.name,
                     .on_screen = at.on_screen});
        }
    }

    std::vector<EnvelopeRow> rows;

  private:
    void measure(const MapUnderTest& map, const render::MapBuffers& buffers, EnvelopeRow row) {
        const Probes probes =
            make_probes(map, row.image, options_.quick ? kPositions / 4 : kPositions, random_);
        row.cpu = judge(map, probes, map.run(probes.inputs), row);
        row.device =
            judge(map, probes,
                  probe_.run(buffers, map.uniforms(), map.in_gaze_frame(), probes.inputs), row);
        const bool small =
            row.on_screen && std::max(row.image.width_px, row.image.height_px) <= 4096;
        row.target_px = std::max(small ? 0.01 : 0.05, 2.0 * row.conditioning_px);
        row.device_target_px = std::max(small ? 0.02 : 0.05, 2.0 * row.conditioning_px);
        rows.push_back(std::move(row));
    }

    const render::VulkanContext& context_;
    const EnvelopeOptions& options_;
    MapProbe probe_;
    std::mt19937_64 random_;
};

template <typename Build>
double median_ms(const Build& build) {
    std::array<double, 9> ms{};
    for (double& each : ms) {
        const auto begin = std::chrono::steady_clock::now();
        const foveation::MapTables tables = build();
        each = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
                   .count();
        if (tables.column.empty()) {
            return std::numeric_limits<double>::quiet_NaN();
        }
    }
    std::ranges::sort(ms);
    return ms[ms.size() / 2];
}

std::vector<TableBuild> measure_tables(bool quick) {
    constexpr ImageSize kEye{2160, 2160};
    std::vector<TableBuild> builds;
    for (const NamedKernel& named : kernels(quick)) {
        const LpSize lp = value_or_throw(lp_buffer_size({.kernel = named.kernel}, kEye));
        builds.push_back(
            {named.name, median_ms([&] { return build_map_tables(named.kernel, lp); })});
    }
    const AcuityProfile profile = value_or_throw(AcuityProfile::create({}, headset_view(kEye)));
    builds.push_back({"acuity m=0.022", median_ms([&] { return build_map_tables(profile); })});
    return builds;
}

}  // namespace

bool Envelope::met() const {
    return draws_not_finite == 0 && draws_outside == 0 &&
           std::ranges::all_of(rows, [](const EnvelopeRow& row) { return row.met(); });
}

Envelope measure_envelope(const render::VulkanContext& context, const EnvelopeOptions& options) {
    const auto begin = std::chrono::steady_clock::now();
    const std::vector<ImageSize> images =
        options.quick ? std::vector<ImageSize>{{1280, 1440}}
                      : std::vector<ImageSize>{{1280, 1440}, {4096, 4096}, {16384, 16384}};
    const std::vector<double> sigmas =
        options.quick ? std::vector{1.8} : std::vector{0.5, 1.0, 1.8, 8.0, 32.0};
    const std::vector<double> slopes =
        options.quick ? std::vector{0.022} : std::vector{0.011, 0.022, 0.034};
    Measurement measurement(context, options);
    for (const ImageSize& image : images) {
        for (const NamedKernel& named : kernels(options.quick)) {
            for (const double sigma : sigmas) {
                measurement.picture_frame(named, image, sigma);
            }
        }
        for (const double slope : slopes) {
            measurement.gaze_frame(slope, image);
        }
    }
    const DrawCounts draws = draw_extremes(options.quick ? kQuickDraws : kDraws, options.seed);
    Envelope envelope{.device = context.device_name(),
                      .driver = context.driver(),
                      .rows = std::move(measurement.rows),
                      .tables = measure_tables(options.quick),
                      .draws = draws.draws,
                      .draws_not_finite = draws.not_finite,
                      .draws_outside = draws.outside};
    envelope.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return envelope;
}

}  // namespace gazeloop::numerics
