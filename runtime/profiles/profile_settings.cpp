#include "runtime/profiles/profile_settings.h"

namespace gazeloop::profiles {

std::vector<settings::SettingRow> rows_of(ProfileSettings& profile) {
    using settings::Concerns;
    using settings::Path;
    return {
        // Who watches a run decides what it is held against, also when a recording is run again.
        {"profile.budget", "latency budget: none, a name or a .toml file",
         Path{&profile.budget, ".toml"}, Concerns::Machine},
        // Views, refresh period and what photons need are recorded.
        {"profile.display", "display profile: a name or a .toml file",
         Path{&profile.display, ".toml"}, Concerns::Input},
        {"profile.tracker", "tracker profile: a name or a .toml file",
         Path{&profile.tracker, ".toml"}, Concerns::Input},
    };
}

}  // namespace gazeloop::profiles
