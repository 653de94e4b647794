#include "runtime/settings/profiles_in_force.h"

#include <fmt/core.h>

namespace gazeloop::settings {

Expected<display::DisplayProfile> display_in_force(const Settings& settings) {
    return settings.at_origin("profile.display", load_display(settings.values().profile.display));
}

Expected<TrackerProfile> tracker_in_force(const Settings& settings) {
    return settings.at_origin("profile.tracker", load_tracker(settings.values().profile.tracker));
}

Expected<TrackerProfile> simulate_tracker_in_force(Settings& settings) {
    auto tracker = tracker_in_force(settings);
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

}  // namespace gazeloop::settings
