#include "runtime/methods/plan_methods.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <utility>

#include "runtime/foveation/log_polar/degenerate_map.h"
#include "runtime/foveation/plans/acuity_density.h"
#include "runtime/foveation/plans/acuity_plan.h"
#include "runtime/foveation/plans/kfr_density.h"
#include "runtime/foveation/plans/layer_plan.h"
#include "runtime/foveation/plans/sampling_plan.h"
#include "runtime/foveation/plans/shading_rings.h"
#include "runtime/foveation/plans/sparse_pattern.h"

namespace gazeloop::methods {
namespace {

using foveation::ImageSize;

ImageSize image_size(const PlanSubject& subject) {
    return {subject.field.view().width_px, subject.field.view().height_px};
}

Expected<PlannedMethod> plan_full(const PlanSubject& subject) {
    const ImageSize image = image_size(subject);
    return PlannedMethod{.parameters = "",
                         .samples = std::uint64_t{image.width_px} * image.height_px,
                         .density = std::make_unique<foveation::FullDensity>()};
}

Expected<PlannedMethod> plan_kfr(const PlanSubject& subject) {
    const KfrSettings& set = subject.values.kfr;
    const auto stated = parameters(set, subject.settings);
    if (!stated) {
        return std::unexpected(stated.error());
    }
    const foveation::KfrParameters& kfr = *stated;
    const ImageSize image = image_size(subject);
    const auto lp = foveation::lp_buffer_size(kfr, image);
    if (!lp) {
        return std::unexpected(lp.error());
    }
    foveation::SamplingPlan plan;
    const gaze::PixelPosition fovea = subject.field.fovea();
    foveation::plan_kfr(kfr, *lp, image, fovea, plan);
    const foveation::LogPolarMap map(kfr.kernel, image, fovea);
    const double core_px = plan.disc_radius_px - plan.disc_border_px;
    return PlannedMethod{
        .parameters = fmt::format(
            "sigma {}, {}, {}", set.sigma,
            set.kernel == "power" ? fmt::format("alpha {}", set.alpha) : "kernel " + set.kernel,
            set.disc ? "disc" : "no disc"),
        .samples = plan.texels_shaded + plan.pixels_direct,
        .density = std::make_unique<foveation::KfrDensity>(map, *lp, fovea, core_px),
        .figures = {{"lp_width", static_cast<double>(lp->width)},
                    {"lp_height", static_cast<double>(lp->height)},
                    {"texels_shaded", static_cast<double>(plan.texels_shaded)},
                    {"texels_off_screen", static_cast<double>(plan.texels_off_screen)},
                    {"texels_under_disc", static_cast<double>(plan.texels_under_disc)},
                    {"disc_pixels", static_cast<double>(plan.pixels_direct)},
                    {"disc_radius_px", plan.disc_radius_px}},
        .useless = foveation::why_degenerate(map, *lp, core_px)};
}

Expected<PlannedMethod> plan_acuity(const PlanSubject& subject) {
    const foveation::AcuityParameters acuity = parameters(subject.values.acuity);
    const gaze::EyeView& view = subject.field.view();
    const auto profile = foveation::AcuityProfile::create(acuity, view);
    if (!profile) {
        return std::unexpected(profile.error());
    }
    foveation::SamplingPlan plan;
    foveation::plan_acuity(acuity, *profile, view, subject.field.gaze(), plan);
    const double core = plan.in_gaze_frame->disc_half_sine - plan.in_gaze_frame->border_half_sine;
    return PlannedMethod{
        .parameters = fmt::format("m {}, {}", acuity.mar.slope, acuity.disc ? "disc" : "no disc"),
        .samples = plan.texels_shaded + plan.pixels_direct,
        .density = std::make_unique<foveation::AcuityDensity>(
            foveation::AcuityMap(*profile, subject.field.frame()),
            glm::degrees(2.0 * std::asin(core))),
        .figures = {{"lp_width", static_cast<double>(plan.lp.width)},
                    {"lp_height", static_cast<double>(plan.lp.height)},
                    {"texels_shaded", static_cast<double>(plan.texels_shaded)},
                    {"texels_off_screen", static_cast<double>(plan.texels_off_screen)},
                    {"texels_under_disc", static_cast<double>(plan.texels_under_disc)},
                    {"disc_pixels", static_cast<double>(plan.pixels_direct)}}};
}

Expected<PlannedMethod> plan_layers(const PlanSubject& subject) {
    const LayersSettings& set = subject.values.layers;
    auto plan = foveation::plan_layers(subject.field, subject.line, parameters(set));
    if (!plan) {
        return std::unexpected(plan.error());
    }
    PlannedMethod method{
        .parameters = fmt::format("n {}{}, m {}", set.n, set.s2_fixed ? " with s2 = 2" : "",
                                  subject.line.slope),
        .samples = plan->samples(),
        .density = nullptr,
        .figures = {{"weighted_samples", plan->weighted_samples()}}};
    for (std::size_t i = 0; i < plan->layers.size(); ++i) {
        const foveation::PlannedLayer& layer = plan->layers[i];
        const auto add = [&](const char* what, double value) {
            method.figures.push_back({fmt::format("layer{}_{}", i + 1, what), value});
        };
        add("radius_deg", layer.radius_deg);
        add("factor", layer.factor);
        add("width", layer.width);
        add("height", layer.height);
    }
    method.density = std::make_unique<foveation::LayerDensity>(std::move(*plan));
    return method;
}

Expected<PlannedMethod> plan_rings(const PlanSubject& subject) {
    const auto rings = parameters(subject.values.rings, subject.field.view(), subject.line);
    if (!rings) {
        return std::unexpected(rings.error());
    }
    auto plan = foveation::plan_rings(subject.field, *rings);
    if (!plan) {
        return std::unexpected(plan.error());
    }
    PlannedMethod method{
        .parameters = fmt::format("1x1 to {:.1f}, 2x2 to {:.1f} deg, tiles of {} px",
                                  rings->inner_deg, rings->outer_deg, rings->tile_px),
        .samples = plan->samples(),
        .density = nullptr,
        .figures = {{"inner_deg", rings->inner_deg},
                    {"outer_deg", rings->outer_deg},
                    {"samples_1x1", static_cast<double>(plan->samples_at[0])},
                    {"samples_2x2", static_cast<double>(plan->samples_at[1])},
                    {"samples_4x4", static_cast<double>(plan->samples_at[2])}}};
    method.density = std::make_unique<foveation::RingDensity>(std::move(*plan));
    return method;
}

Expected<PlannedMethod> plan_sparse(const PlanSubject& subject) {
    const foveation::SparseParameters sparse = parameters(subject.values.sparse);
    const auto pattern = foveation::make_sparse_pattern(sparse, image_size(subject));
    if (!pattern) {
        return std::unexpected(pattern.error());
    }
    const gaze::PixelPosition fovea = subject.field.fovea();
    return PlannedMethod{
        .parameters = fmt::format(
            "share {}, {}", sparse.share,
            sparse.placement == foveation::SparsePlacement::BlueNoise ? "blue noise" : "gaussian"),
        .samples = pattern->samples_in(fovea),
        .density = std::make_unique<foveation::SparseDensity>(pattern->profile, fovea),
        .figures = {{"field_samples", static_cast<double>(pattern->samples.size())},
                    {"disc_radius_px", pattern->profile.disc_radius_px}}};
}

constexpr std::array kMethods{PlanMethod{"full", plan_full},     PlanMethod{"kfr", plan_kfr},
                              PlanMethod{"acuity", plan_acuity}, PlanMethod{"layers", plan_layers},
                              PlanMethod{"rings", plan_rings},   PlanMethod{"sparse", plan_sparse}};

}  // namespace

std::span<const PlanMethod> plan_methods() { return kMethods; }

}  // namespace gazeloop::methods
