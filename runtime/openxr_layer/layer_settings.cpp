#include "runtime/openxr_layer/layer_settings.h"

namespace gazeloop::openxr_layer {

std::vector<settings::SettingRow> rows_of(LayerSettings& layer) {
    using settings::Choice;
    using settings::Concerns;
    return {
        {"layer.eye_gaze", "when the API layer provides XR_EXT_eye_gaze_interaction",
         Choice{.value = &layer.eye_gaze, .names = {"where-lacking", "always", "never"}},
         Concerns::Machine},
        {"layer.gaze", "whose gaze applications get from the API layer: a source, as run --gaze",
         Choice{.value = &layer.gaze, .what = "source"}, Concerns::Machine},
        {"layer.record",
         "where the API layer records an application: a session, or a folder for them",
         settings::Path{.value = &layer.record, .extension = ""}, Concerns::Machine},
        {"layer.unknown_applications", "whether applications that were not decided on get gaze",
         Choice{.value = &layer.unknown_applications, .names = {"allow", "ask", "deny"}},
         Concerns::Machine},
    };
}

}  // namespace gazeloop::openxr_layer
