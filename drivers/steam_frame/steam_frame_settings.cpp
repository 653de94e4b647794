#include "drivers/steam_frame/steam_frame_settings.h"

#include "drivers/steam_frame/poll_times.h"

namespace gazeloop::drivers::steam_frame {
namespace {

constexpr const char* kFiltered = "filtered";
constexpr const char* kBeforeFusion = "before-fusion";

}  // namespace

std::vector<settings::SettingRow> rows_of(SteamFrameSettings& steam_frame) {
    using settings::Choice;
    using settings::Concerns;
    using settings::Path;
    return {
        {"steam_frame.file", "Steam Frame: the file that its eye service writes",
         Path{&steam_frame.file, ""}, Concerns::Input},
        {"steam_frame.rays",
         "Steam Frame: filtered (fused of both eyes, smoothed by the service) or before-fusion "
         "(each eye by itself)",
         Choice{&steam_frame.rays, {kFiltered, kBeforeFusion}}, Concerns::Input},
    };
}

SteamFrameOptions options_of(const SteamFrameSettings& steam_frame, const TrackerDelay& delay) {
    SteamFrameOptions options{
        .file = steam_frame.file,
        .delay = delay,
        .rays = steam_frame.rays == kBeforeFusion ? Rays::BeforeFusion : Rays::Filtered};
    options.delay.polling_ns = PollTimes::kStep_ns;
    return options;
}

}  // namespace gazeloop::drivers::steam_frame
