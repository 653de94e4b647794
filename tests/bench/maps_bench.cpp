#include <fmt/core.h>

#include <chrono>
#include <numbers>

#include "runtime/error.h"
#include "runtime/foveation/plans/acuity_plan.h"
#include "runtime/foveation/plans/kfr_plan.h"
#include "runtime/numerics/table_builds.h"
#include "tests/bench/bench.h"

namespace gazeloop::bench {
namespace {

constexpr const char* kBench = "maps";
constexpr const char* kCase = "2160x2160";

gaze::EyeView square_view() {
    constexpr double kHalf_rad = 50.0 * std::numbers::pi / 180.0;
    return {
        .fov = {-kHalf_rad, kHalf_rad, kHalf_rad, -kHalf_rad}, .width_px = 2160, .height_px = 2160};
}

/// What a frame does for an eye when the gaze has moved: a plan and its uniforms, over gazes all
/// over the picture.
template <typename Plan>
double new_gaze_ms(const Plan& plan_at) {
    const gaze::EyeView view = square_view();
    foveation::LogPolarPlan plan;
    std::vector<double> ms;
    double sum = 0.0;
    for (int i = 0; i < 200; ++i) {
        const gaze::PixelPosition at{i * 977 % 2160 + 0.25, i * 1471 % 2160 + 0.75};
        const auto begin = std::chrono::steady_clock::now();
        plan_at(view, at, plan);
        sum +=
            static_cast<double>(foveation::map_uniforms(plan).lp_and_disc.z);  // the work is used
        ms.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
                .count());
    }
    return sum > 0.0 ? median(ms) : 0.0;
}

}  // namespace

std::vector<Figure> maps(const Options& options) {
    std::vector<Figure> figures;
    if (!options.wants(kCase)) {
        return figures;
    }
    for (const numerics::TableBuild& build : numerics::measure_table_builds(false)) {
        figures.push_back({kBench, kCase, "tables, " + build.map, build.milliseconds, "ms", "lower",
                           std::nullopt, numerics::TableBuild::kTargetMs});
    }
    const foveation::KfrParameters kfr;
    const foveation::LpSize lp = value_or_throw(foveation::lp_buffer_size(kfr, {2160, 2160}));
    const foveation::AcuityParameters acuity;
    const auto profile = value_or_throw(foveation::AcuityProfile::create(acuity, square_view()));
    const auto add = [&](const char* metric, double ms) {
        figures.push_back({kBench, kCase, metric, ms, "ms", "lower"});
    };
    add("a new gaze, kfr", new_gaze_ms([&](const gaze::EyeView&, const gaze::PixelPosition& at,
                                           foveation::LogPolarPlan& plan) {
            foveation::plan_kfr(kfr, lp, {2160, 2160}, at, plan);
        }));
    add("a new gaze, acuity",
        new_gaze_ms([&](const gaze::EyeView& view, const gaze::PixelPosition& at,
                        foveation::LogPolarPlan& plan) {
            foveation::plan_acuity(acuity, profile, view, gaze::unproject(at, view), plan);
        }));
    return figures;
}

}  // namespace gazeloop::bench
