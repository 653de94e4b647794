#include "runtime/numerics/envelope.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <random>

#include "runtime/foveation/log_polar/degenerate_map.h"
#include "runtime/numerics/errors.h"
#include "runtime/numerics/maps_of_interest.h"
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

class Measurement {
  public:
    Measurement(const vulkan::Context& context, const EnvelopeOptions& options)
        : context_(context), options_(options), probe_(context), random_(options.seed) {}

    void picture_frame(const NamedKernel& named, ImageSize image, double sigma) {
        const auto lp = lp_buffer_size({.sigma = sigma, .kernel = named.kernel}, image);
        if (!lp) {
            return;  // more texels than a device holds
        }
        const auto family = std::make_shared<const MapFamily>(
            MapFamily{build_map_tables(named.kernel, *lp), foveation::MapError(named.kernel)});
        const render::MapBuffers buffers(context_, family->tables, 1, lp->height);
        for (const NamedFovea& at : kFoveae) {
            const PixelPosition fovea{at.x * image.width_px, at.y * image.height_px};
            measure(MapUnderTest(family, named.kernel, *lp, image, fovea), buffers,
                    {.map = named.name,
                     .image = image,
                     .sigma = sigma,
                     .lp = *lp,
                     .fovea = at.name,
                     .on_screen = at.on_screen,
                     .useless = foveation::why_degenerate(LogPolarMap(named.kernel, image, fovea),
                                                          *lp, 0.0)});
        }
    }

    void gaze_frame(double slope, ImageSize image) {
        const gaze::EyeView view = headset_view(image);
        const AcuityProfile profile =
            value_or_throw(AcuityProfile::create({.mar = {.slope = slope}}, view));
        const auto family = std::make_shared<const MapFamily>(
            MapFamily{build_map_tables(profile), foveation::MapError(profile)});
        const render::MapBuffers buffers(context_, family->tables, 1, profile.lp().height);
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
        row.stated_px = small ? 0.01 : 0.05;
        row.target_px = std::max(row.stated_px, 2.0 * row.conditioning_px);
        row.device_target_px = std::max(small ? 0.02 : 0.05, 2.0 * row.conditioning_px);
        rows.push_back(std::move(row));
    }

    const vulkan::Context& context_;
    const EnvelopeOptions& options_;
    MapProbe probe_;
    std::mt19937_64 random_;
};

}  // namespace

EnvelopeCounts Envelope::counts() const {
    EnvelopeCounts counts;
    for (const EnvelopeRow& row : rows) {
        if (!row.useless.empty()) {
            ++counts.useless;
            continue;
        }
        ++counts.useful;
        counts.met += row.met() ? 1 : 0;
        counts.for_float32 += row.met_for_float32() ? 1 : 0;
    }
    return counts;
}

bool Envelope::met() const {
    return draws_not_finite == 0 && draws_outside == 0 &&
           std::ranges::all_of(rows, [](const EnvelopeRow& row) { return row.met(); });
}

Envelope measure_envelope(const vulkan::Context& context, const EnvelopeOptions& options) {
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
        for (const NamedKernel& named : kernels_under_test(options.quick)) {
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
                      .tables = measure_table_builds(options.quick),
                      .draws = draws.draws,
                      .draws_not_finite = draws.not_finite,
                      .draws_outside = draws.outside};
    envelope.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return envelope;
}

}  // namespace gazeloop::numerics
