#include "runtime/run/target_settings.h"

namespace gazeloop::run {

std::vector<settings::SettingRow> rows_of(TargetSettings& target) {
    using settings::Concerns;
    return {
        {"target.name", "where pictures go",
         settings::Choice{.value = &target.name, .names = {"openxr", "headless"}, .what = "target"},
         Concerns::Machine},
        {"target.validation", "load the OpenXR core validation layer", &target.validation,
         Concerns::Machine},
    };
}

}  // namespace gazeloop::run
