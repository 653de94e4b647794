#include "drivers/device/silence.h"

#include <fmt/format.h>

namespace gazeloop::drivers {

std::optional<std::string> silence_text(const TrackerCounts& counts, double seconds,
                                        std::string_view why_silent) {
    if (counts.samples > 0) {
        return std::nullopt;
    }
    if (counts.reports == 0) {
        return fmt::format("opened, no report in {:.3g} s: {}", seconds, why_silent);
    }
    return fmt::format(
        "opened, {} reports in {:.3g} s, but none of gaze: it may see no eyes, or want its maker's "
        "calibration",
        counts.reports, seconds);
}

}  // namespace gazeloop::drivers
