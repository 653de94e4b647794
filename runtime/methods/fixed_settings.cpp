#include "runtime/methods/fixed_settings.h"

#include "runtime/methods/only_under.h"

namespace gazeloop::methods {

std::vector<settings::SettingRow> rows_of(FixedSettings& fixed) {
    return {{"fixed.method", "the method whose fovea is held straight ahead",
             settings::Choice{.value = &fixed.method,
                              .names = {"kfr", "acuity", "layers", "rings", "sparse", "quad",
                                        "kfr3d", "interleaved"}},
             settings::Concerns::Picture, only_under({})}};
}

}  // namespace gazeloop::methods
