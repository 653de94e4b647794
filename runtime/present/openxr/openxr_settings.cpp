#include "runtime/present/openxr/openxr_settings.h"

namespace gazeloop::present {

std::vector<settings::SettingRow> rows_of(OpenXrSettings& openxr) {
    constexpr double kHour_s = 3600.0;
    return {{"openxr.patience_s",
             "end when the runtime announces no display time for this long; 0: at once",
             settings::Number{&openxr.patience_s, 0.0, kHour_s}, settings::Concerns::Machine}};
}

}  // namespace gazeloop::present
