#pragma once

#include <cstdint>
#include <vector>

#include "runtime/error.h"
#include "runtime/foveation/eye/mar_line.h"
#include "runtime/foveation/plans/shading_rings.h"
#include "runtime/gaze/view.h"
#include "runtime/settings/setting_row.h"

namespace gazeloop::methods {

/// The settings rings.*
struct RingsSettings {
    double inner_deg = 0.0;
    double outer_deg = 0.0;
    std::int64_t tile_px = 16;
};

[[nodiscard]] std::vector<settings::SettingRow> rows_of(RingsSettings& rings);

/// The rings by these settings; where they state none, the narrowest ones that satisfy `line` in
/// `view`. Errors (Usage): as GuenterAcuity::create.
[[nodiscard]] Expected<foveation::RingParameters> parameters(const RingsSettings& rings,
                                                             const gaze::EyeView& view,
                                                             const foveation::MarLine& line);

}  // namespace gazeloop::methods
