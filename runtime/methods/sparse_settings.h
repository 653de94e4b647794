#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/foveation/plans/sparse_pattern.h"
#include "runtime/settings/setting_row.h"

namespace gazeloop::methods {

/// The settings sparse.*
struct SparseSettings {
    double share = 0.1;
    double disc_share = 0.25;
    double narrow_share = 0.4;
    double narrow_spread = 0.1;
    double wide_spread = 0.3;
    std::string placement = "gaussian";
    std::int64_t k = 4;
    bool depth_guided = false;
    bool turn = false;
    bool accumulate = false;
};

[[nodiscard]] std::vector<settings::SettingRow> rows_of(SparseSettings& sparse);

[[nodiscard]] foveation::SparseParameters parameters(const SparseSettings& sparse);

}  // namespace gazeloop::methods
