// Whatever the display, the gaze and the parameters: plans are refused by name, or hold what they
// promise.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "runtime/foveation/eye/fewest_samples.h"
#include "runtime/foveation/eye/fovea_widening.h"
#include "runtime/foveation/eye/geisler_perry_acuity.h"
#include "runtime/foveation/eye/guenter_acuity.h"
#include "runtime/foveation/eye/stela_acuity.h"
#include "runtime/foveation/picture/gaze_field.h"
#include "runtime/foveation/plans/eccentricity_layers.h"
#include "runtime/foveation/plans/layer_plan.h"
#include "runtime/foveation/plans/shading_rings.h"
#include "runtime/foveation/plans/sparse_pattern.h"
#include "tests/support/generated_numbers.h"

namespace gazeloop::foveation {
namespace {

using tests::anything;
using tests::between;

gaze::EyeView any_view() {
    const double left = -between(0.5, 84.0);
    const double down = -between(0.5, 84.0);
    return {.fov = {glm::radians(left), glm::radians(between(0.5, 84.0)),
                    glm::radians(between(0.5, 84.0)), glm::radians(down)},
            .width_px = *rc::gen::element<std::uint32_t>(2, 3, 16, 200, 1280, 16384),
            .height_px = *rc::gen::element<std::uint32_t>(2, 5, 17, 200, 1440, 16384)};
}

glm::dvec3 any_gaze() {
    const double azimuth = glm::radians(between(-180.0, 180.0));
    const double elevation = glm::radians(between(-90.0, 90.0));
    return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
            -std::cos(elevation) * std::cos(azimuth)};
}

RC_GTEST_PROP(GazeFieldProperty, PolarAndPixelFormsAgreeAnywhere, ()) {
    const GazeField field = GazeField::create(any_view(), any_gaze()).value();
    const gaze::PixelPosition pixel{between(0.0, field.view().width_px),
                                    between(0.0, field.view().height_px)};
    const FieldPoint at = field.at(pixel);
    RC_ASSERT(std::isfinite(at.eccentricity_deg));
    RC_ASSERT(std::isfinite(glm::determinant(at.px_per_deg)));
    RC_ASSERT(at.eccentricity_deg <= field.greatest_eccentricity_deg() + 1e-6);
    if (at.eccentricity_deg > 0.01 && at.eccentricity_deg < 179.99) {
        const auto back = field.at(at.eccentricity_deg, at.direction_rad);
        if (back) {  // not if rounding moved it over the edge
            RC_ASSERT(std::abs(back->pixel.x_px - pixel.x_px) < 1e-4);
            RC_ASSERT(std::abs(back->pixel.y_px - pixel.y_px) < 1e-4);
        }
    }
}

RC_GTEST_PROP(AcuityProperty, NeverRisesWithEccentricity, ()) {
    const auto guenter =
        GuenterAcuity::create({.slope = between(MarLine::kMinSlope, MarLine::kMaxSlope)}).value();
    const auto stela = StelaAcuity::create({.luminance_cd_m2 = std::pow(10.0, between(-3, 4)),
                                            .temporal_hz = between(0, 60),
                                            .area_deg2 = std::pow(10.0, between(-4, 4))},
                                           StelaField::Directional)
                           .value();
    const GeislerPerryAcuity geisler_perry;
    const double near = between(0.0, 180.0);
    const double far = between(near, 180.0);
    const double nasal = between(0.0, 1.0);
    for (const AcuityModel* const model : {static_cast<const AcuityModel*>(guenter.get()),
                                           static_cast<const AcuityModel*>(stela.get()),
                                           static_cast<const AcuityModel*>(&geisler_perry)}) {
        const double here = model->cutoff_cpd(near, nasal);
        const double there = model->cutoff_cpd(far, nasal);
        RC_ASSERT(std::isfinite(here) && here >= 0.0);
        RC_ASSERT(there <= here * (1.0 + 1e-9));
    }
}

RC_GTEST_PROP(AcuityProperty, IsRefusedOrUsable, ()) {
    if (const auto model = GuenterAcuity::create({anything(), anything()})) {
        RC_ASSERT(std::isfinite((*model)->cutoff_cpd(180.0, 0.0)));
    }
    if (const auto model =
            StelaAcuity::create({anything(), anything(), anything()}, StelaField::Directional)) {
        RC_ASSERT(std::isfinite((*model)->cutoff_cpd(7.0, 0.5)));
    }
    GazeUncertainty u{anything(), anything(), anything(), anything(), anything()};
    if (const auto widened = widening_deg(u)) {
        RC_ASSERT(*widened >= 0.0 && *widened <= kMaxWideningDeg);
    }
}

RC_GTEST_PROP(LayerProperty, KeepToTheLineAndTheDisplay, ()) {
    const LayerDisplay display{std::tan(glm::radians(between(0.05, 89.0))),
                               std::pow(10.0, between(0.4, 5.0)), between(0.2, 5.0)};
    const MarLine line{.slope = std::pow(10.0, between(-5.9, 0.0))};
    const LayerOptions options{.layers = *rc::gen::inRange(1, 6), .weights = {}};
    const EccentricityLayers best = optimise_layers(display, line, options).value();
    RC_ASSERT(best.layers.size() <= static_cast<std::size_t>(options.layers));
    RC_ASSERT(best.work <= best.display_pixels * (1.0 + 1e-12));
    double inner = 0.0;
    double work = 0.0;
    for (std::size_t i = 0; i < best.layers.size(); ++i) {
        const EccentricityLayer& layer = best.layers[i];
        // The last layer of a display longer than its side may lie wholly beyond that side's edge.
        RC_ASSERT(layer.radius_deg > inner || (i + 1 == best.layers.size() &&
                                               display.aspect > 1.0 && layer.radius_deg == inner));
        // Never coarser than the line at the layer's inner edge.
        RC_ASSERT(layer.factor * display.sharpness_deg() <=
                  std::max(display.sharpness_deg(), line.omega_deg(inner)) * (1.0 + 1e-9));
        inner = layer.radius_deg;
        work += layer.pixels;
    }
    RC_ASSERT(std::abs(work - best.work) <= 1e-6 * best.work);
}

RC_GTEST_PROP(LayerProperty, AreRefusedOrFinite, ()) {
    const auto layers = optimise_layers(
        {anything(), anything(), anything()}, {anything()},
        {.layers = *rc::gen::arbitrary<int>(), .weights = {}, .second_factor = anything()});
    if (layers) {
        RC_ASSERT(std::isfinite(layers->work) && layers->work > 0.0);
    } else {
        RC_ASSERT(layers.error().kind == ErrorKind::Usage);
        RC_ASSERT(layers.error().message.find("must") != std::string::npos);
    }
}

RC_GTEST_PROP(PlanProperty, OfLayersAndRingsStayInsideThePicture, ()) {
    const gaze::EyeView view = any_view();
    const GazeField field = GazeField::create(view, any_gaze()).value();
    const std::uint64_t pixels = std::uint64_t{view.width_px} * view.height_px;
    const auto layers = plan_layers(field, {}, {.layers = 3, .weights = {}}).value();
    for (const PlannedLayer& layer : layers.layers) {
        RC_ASSERT(layer.covers.x1 <= view.width_px && layer.covers.y1 <= view.height_px);
        RC_ASSERT(std::uint64_t{layer.width} * layer.height <= layer.covers.area());
    }
    const double inner = between(0.0, 180.0);
    const auto rings = plan_rings(field, {inner, between(inner, 180.0), 64}).value();
    RC_ASSERT(rings.samples() <= pixels);
    RC_ASSERT(rings.samples() * 16 >= pixels);
}

}  // namespace
}  // namespace gazeloop::foveation
