#include "runtime/methods/method_settings.h"

namespace gazeloop::methods {

std::vector<settings::SettingRow> rows_of(MethodSettings& methods) {
    auto& [acuity, kfr, layers, rings, sparse] = methods;
    std::vector<settings::SettingRow> rows;
    for (auto& more :
         {rows_of(acuity), rows_of(kfr), rows_of(layers), rows_of(rings), rows_of(sparse)}) {
        rows.insert(rows.end(), more.begin(), more.end());
    }
    return rows;
}

}  // namespace gazeloop::methods
