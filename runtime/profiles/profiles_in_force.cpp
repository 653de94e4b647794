#include "runtime/profiles/profiles_in_force.h"

#include <fmt/core.h>

namespace gazeloop::profiles {

Expected<display::DisplayProfile> display_in_force(const ProfileSettings& named,
                                                   const settings::Settings& all) {
    return all.at_origin("profile.display", load_display(named.display));
}

Expected<TrackerProfile> tracker_in_force(const ProfileSettings& named,
                                          const settings::Settings& all) {
    return all.at_origin("profile.tracker", load_tracker(named.tracker));
}

Expected<std::optional<latency::LatencyBudget>> budget_in_force(const ProfileSettings& named,
                                                                const settings::Settings& all) {
    if (named.budget == kNoBudget) {
        return std::nullopt;
    }
    return all.at_origin("profile.budget", load_budget(named.budget));
}

Expected<TrackerProfile> simulate_tracker_in_force(const ProfileSettings& named,
                                                   settings::Settings& all) {
    auto tracker = tracker_in_force(named, all);
    if (!tracker) {
        return tracker;
    }
    for (const auto& [term, value] : tracker->terms) {
        if (const auto set = all.set_default(fmt::format("sim.{}", term), fmt::format("{}", value),
                                             tracker->name);
            !set) {
            return std::unexpected(set.error());
        }
    }
    return tracker;
}

}  // namespace gazeloop::profiles
