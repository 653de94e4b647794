#include "runtime/cli/tracker_settings.h"

#include <fmt/core.h>

namespace gazeloop::cli {

Expected<TrackerProfile> tracker_in_force(Settings& settings) {
    auto tracker = load_tracker(settings.values().profile.tracker);
    if (!tracker) {
        return tracker;
    }
    for (const auto& [term, value] : tracker->terms) {
        if (const auto set = settings.set_default(fmt::format("sim.{}", term),
                                                  fmt::format("{}", value), tracker->name);
            !set) {
            return std::unexpected(set.error());
        }
    }
    return tracker;
}

}  // namespace gazeloop::cli
