#include "runtime/methods/quad_settings.h"

#include "runtime/methods/only_under.h"

namespace gazeloop::methods {

std::vector<settings::SettingRow> rows_of(QuadSettings& quad) {
    using settings::Concerns;
    using settings::Number;
    const settings::OnlyWhile only = only_under({"quad"});
    return {
        {"quad.blend", "share of the inset's sides over which it is blended into the periphery",
         Number{&quad.blend, 0.0, 1.0}, Concerns::Picture, only},
        {"quad.periphery", "samples per pixel each way outside the inset",
         Number{&quad.periphery, 0.05, 1.0}, Concerns::Picture, only},
        {"quad.section", "sides of the inset at full resolution, as a share of the picture's",
         Number{&quad.section, 0.05, 1.0}, Concerns::Picture, only},
    };
}

std::vector<foveation::LayerShape> layers(const QuadSettings& quad) {
    return {{.share = quad.section, .blend = quad.blend}, {.factor = 1.0 / quad.periphery}};
}

}  // namespace gazeloop::methods
