#include "runtime/openxr_layer/layer_settings.h"

#include "runtime/foveation/eye/mar_line.h"

namespace gazeloop::openxr_layer {

std::vector<settings::SettingRow> rows_of(LayerSettings& layer) {
    using settings::Choice;
    using settings::Concerns;
    using settings::Number;
    return {
        {"layer.blend", "of an inset's half sides, the share over which it is blended",
         Number{&layer.blend, 0.0, 0.9}, Concerns::Machine},
        {"layer.eye_gaze", "when the API layer provides XR_EXT_eye_gaze_interaction",
         Choice{.value = &layer.eye_gaze, .names = {"where-lacking", "always", "never"}},
         Concerns::Machine},
        {"layer.foveation",
         "when the API layer provides XR_FB_foveation and XR_META_foveation_eye_tracked",
         Choice{.value = &layer.foveation, .names = {"where-lacking", "never"}}, Concerns::Machine},
        {"layer.gaze", "whose gaze applications get from the API layer: a source, as run --gaze",
         Choice{.value = &layer.gaze, .what = "source"}, Concerns::Machine},
        {"layer.mar", "slope of the acuity line that sizes insets (Guenter et al. 2012)",
         Number{&layer.mar, foveation::MarLine::kMinSlope, foveation::MarLine::kMaxSlope},
         Concerns::Machine},
        {"layer.periphery", "pixels per pixel of the display each way around an inset",
         Number{&layer.periphery, 0.05, 1.0}, Concerns::Machine},
        {"layer.quad_views", "when the API layer provides XR_VARJO_quad_views",
         Choice{.value = &layer.quad_views, .names = {"where-lacking", "never"}},
         Concerns::Machine},
        {"layer.record",
         "where the API layer records an application: a session, or a folder for them",
         settings::Path{.value = &layer.record, .extension = ""}, Concerns::Machine},
        {"layer.unknown_applications", "whether applications that were not decided on get gaze",
         Choice{.value = &layer.unknown_applications,
                .names = {"allow", "ask", "deny", "foveation"}},
         Concerns::Machine},
    };
}

}  // namespace gazeloop::openxr_layer
