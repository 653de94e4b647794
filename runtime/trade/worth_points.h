#pragma once

#include <string>
#include <vector>

#include "runtime/error.h"
#include "runtime/settings/settings.h"
#include "runtime/trade/sweep_points.h"

namespace gazeloop::trade {

/// What tells each part of a method's worth: the method by the settings in force, then with one of
/// them changed at a time. Parts are its own settings and the filters of render.* that can be
/// switched (off where they are on, and on), that choose among names (every other one), and filters
/// with a size (to the least); and render.require=all, which does what the scene does not need.
/// Settings that have no effect as the others are, are left out. Errors (Usage): no such method.
[[nodiscard]] Expected<std::vector<SweepPoint>> worth_points(const std::string& method,
                                                             const settings::Settings& settings);

}  // namespace gazeloop::trade
