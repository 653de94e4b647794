#pragma once

#include <string>
#include <vector>

namespace gazeloop::numerics {

/// What a map's tables cost to build; no gaze needs new ones.
struct TableBuild {
    /// Most that they may cost.
    static constexpr double kTargetMs = 1.0;

    std::string map;
    double milliseconds = 0.0;  ///< median of 9, one eye of 2160 x 2160
};

/// Of kernels_under_test() and the acuity-derived map.
std::vector<TableBuild> measure_table_builds(bool quick);

}  // namespace gazeloop::numerics
