#include "runtime/run/no_gaze.h"

#include <fmt/core.h>

namespace gazeloop::run {

std::string no_gaze_remedy(std::string_view gaze) {
    const std::size_t colon = gaze.find(':');
    const std::string_view kind = gaze.substr(0, colon);
    const std::string_view argument =
        colon == std::string_view::npos ? std::string_view{} : gaze.substr(colon + 1);
    if (kind == "osc") {
        return fmt::format(
            "no datagram with gaze came to {}: have its sender (VRCFaceTracking, say) send to this "
            "machine and this port, and let a firewall pass them; what else came is said above",
            argument);
    }
    if (kind == "psvr2") {
        return "plug the PlayStation VR2 in by USB and put it on; gazeloop devices says why it "
               "gives none";
    }
    if (kind == "steam-frame") {
        return fmt::format(
            "start SteamVR's eye service on the headset; gazeloop devices{} says why its file "
            "gives "
            "none",
            argument.empty() ? "" : fmt::format(" --set steam_frame.file={}", argument));
    }
    if (kind == "hid") {
        return argument.empty() ? "plug an eye tracker in; gazeloop devices says why one that is "
                                  "there gives none"
                                : fmt::format(
                                      "gazeloop devices lists the eye trackers that are "
                                      "there, and says why {} gives none",
                                      argument);
    }
    return "gazeloop devices says why a tracker gives none";
}

std::optional<std::string> why_no_gaze(const GazeAtEnd& gaze) {
    if (gaze.report.gaze.received > 0) {
        return std::nullopt;
    }
    if (!gaze.fault.empty()) {
        return fmt::format("no gaze came: {}; {}", gaze.fault, no_gaze_remedy(gaze.source));
    }
    if (gaze.live && gaze.from_device && !gaze.by_runtime) {
        return fmt::format("no gaze came from --gaze {}: {}", gaze.source,
                           no_gaze_remedy(gaze.source));
    }
    return std::nullopt;
}

std::string no_gaze_warning(const GazeAtEnd& gaze) {
    const auto& counts = gaze.report.gaze;
    if (!gaze.live || gaze.report.frames.total == 0 ||
        counts.received > counts.invalid + counts.out_of_order) {
        return {};
    }
    return fmt::format("no gaze in all {} frames: {}", gaze.report.frames.total,
                       gaze.from_device
                           ? no_gaze_remedy(gaze.source)
                           : "the run ended before any had arrived, or all of it was lost");
}

}  // namespace gazeloop::run
