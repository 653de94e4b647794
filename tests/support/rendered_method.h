#pragma once

#include "runtime/foveation/plans/acuity_plan.h"
#include "runtime/foveation/plans/kfr_plan.h"
#include "runtime/render/frame_renderer.h"
#include "runtime/render/passes/full_passes.h"
#include "runtime/render/passes/log_polar_passes.h"

// The methods that are rendered, with their parameters as a test or bench states them.
namespace gazeloop::render {

enum class Method : std::uint8_t { Full, Kfr, Acuity };

struct MethodConfig : RendererConfig {
    Method method = Method::Kfr;
    foveation::KfrParameters kfr;
    foveation::AcuityParameters acuity;
};

[[nodiscard]] inline MakePasses passes_of(const MethodConfig& config) {
    switch (config.method) {
        case Method::Full:
            return make_full_passes;
        case Method::Kfr:
            return
                [kfr = config.kfr](const PassSetup& setup) { return make_kfr_passes(setup, kfr); };
        case Method::Acuity:
            return [acuity = config.acuity](const PassSetup& setup) {
                return make_acuity_passes(setup, acuity);
            };
    }
    return {};
}

/// A frame with its gaze, as positions and as unit vectors in the views' frames.
struct FrameRequest : FrameView {
    gaze::PerEye<gaze::PixelPosition> foveae;
    gaze::PerEye<glm::dvec3> gaze_directions{};

    /// What a renderer takes: all but the gaze.
    [[nodiscard]] const FrameView& frame_view() const { return *this; }
    [[nodiscard]] gaze::FrameFovea fovea() const {
        gaze::FrameFovea fovea;
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            fovea.eyes[e].position = foveae[e];
            fovea.eyes[e].direction = gaze_directions[e];
        }
        return fovea;
    }
};

/// What a log-polar method plans for a frame; empty for full resolution.
[[nodiscard]] inline foveation::LogPolarPlan plan_of(const MethodConfig& config,
                                                     const FrameRequest& frame, gaze::Eye eye) {
    const std::size_t e = gaze::index(eye);
    const gaze::EyeView& view = frame.views[e];
    const foveation::ImageSize image{view.width_px, view.height_px};
    foveation::LogPolarPlan plan;
    if (config.method == Method::Kfr) {
        const auto lp = value_or_throw(foveation::lp_buffer_size(config.kfr, image));
        foveation::plan_kfr(config.kfr, lp, image, frame.foveae[e], plan, frame.hidden[e].get());
    } else if (config.method == Method::Acuity) {
        const auto profile = value_or_throw(foveation::AcuityProfile::create(config.acuity, view));
        foveation::plan_acuity(config.acuity, profile, view, frame.gaze_directions[e], plan,
                               frame.hidden[e].get());
    }
    return plan;
}

}  // namespace gazeloop::render
