#include "runtime/scene/light_field_settings.h"

namespace gazeloop::scene {

std::vector<settings::SettingRow> rows_of(LightFieldSettings& light_field) {
    using settings::Choice;
    using settings::Concerns;
    using settings::Number;
    using settings::Whole;
    return {
        {"lightfield.aperture_m",
         "radius of the lens that light fields are seen through; 0: between the nearest views",
         Number{&light_field.aperture_m, 0.0, 1e3}, Concerns::Picture},
        {"lightfield.compression",
         "how a light field's views are kept: bc1 takes an eighth of the memory, with loss",
         Choice{.value = &light_field.compression, .names = {"none", "bc1"}}, Concerns::Picture},
        {"lightfield.focus_m", "distance of the lens's focal plane",
         Number{&light_field.focus_m, 0.01, 1e4}, Concerns::Picture},
        {"lightfield.memory_mib",
         "GPU memory that a light field's views may take, MiB; what is beyond is loaded as frames "
         "need "
         "it",
         Whole{&light_field.memory_mib, 1, 1 << 20}, Concerns::Machine},
        {"lightfield.prefetch",
         "load views that do not fit into that memory before frames ask for them, as the head "
         "moves",
         &light_field.prefetch, Concerns::Machine},
    };
}

}  // namespace gazeloop::scene
