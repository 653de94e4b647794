#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/error.h"
#include "runtime/governor/governor.h"
#include "runtime/settings/settings.h"

namespace gazeloop::governor {

/// The settings governor.*
struct GovernorSettings {
    std::string use = "off";
    std::string front = "raymarch";
    std::string levels;
    double budget_ms = 0.0;
    double budget_share = 0.9;
    bool fit_scale = true;
    double floor = 0.0;
    double floor_saccade = 0.0;
    double floor_blink = 0.0;
    double floor_lost = 0.0;
    std::int64_t settle_frames = 30;
    std::int64_t patience_frames = 180;

    /// ms, of a display with this period; 0: unknown.
    [[nodiscard]] double budget_of(std::int64_t period_ns) const;
};

[[nodiscard]] std::vector<settings::SettingRow> rows_of(GovernorSettings& governor);

/// Puts the front that governor.front names into governor.levels, unless only those were set;
/// governor.front is empty then. So a session holds the front, and its replay needs no file.
/// Errors: as load_front(), with the place where it was named.
Expected<void> take_front(const GovernorSettings& governor, settings::Settings& all);

/// Of governor.levels. Errors: as parse_front(), with the place where it was set.
Expected<Front> front_in_force(const GovernorSettings& governor, const settings::Settings& all);

/// Errors: as worst_levels().
Expected<GovernorOptions> options_of(const GovernorSettings& governor, const Front& front);

}  // namespace gazeloop::governor
