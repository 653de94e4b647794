#include "runtime/cli/device_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

namespace gazeloop::cli {
namespace {

using drivers::hid::TrackerProbe;
using Json = nlohmann::ordered_json;

constexpr std::string_view kVerified =
    "HID usage page 0x12: verified with emulated devices, not tried on hardware";
constexpr std::string_view kNone =
    "No eye tracker was found.\n"
    "  HID: no device declares an eye tracker (usage page 0x12). Is it plugged in and powered? "
    "Most\n"
    "  trackers speak a protocol of their maker's instead, and only his driver makes them HID "
    "ones.\n"
    "  Try the HID path without a tracker: gazeloop simulate tracker\n";

std::string percent(std::uint64_t part, std::uint64_t whole) {
    return fmt::format("{:.0f} %", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

/// Why it isn't tracking; empty where it is.
std::vector<std::string> diagnosis(const TrackerProbe& probe) {
    std::vector<std::string> lines;
    if (probe.problem) {
        lines.push_back(*probe.problem);
    }
    if (probe.tracker.needs_rule) {
        lines.push_back(
            "as root, write this line to /etc/udev/rules.d/70-gazeloop.rules and plug the tracker "
            "in again:");
        lines.push_back("  " +
                        drivers::hid::udev_rule(probe.tracker.vendor, probe.tracker.product));
    }
    if (!probe.problem && probe.counts.samples == 0) {
        lines.push_back(
            "it sends nothing: it may see no eyes (some trackers are then silent), or want its "
            "maker's calibration");
    } else if (!probe.problem && probe.with_gaze == 0) {
        lines.push_back("it sends reports, but none with valid gaze");
    }
    return lines;
}

template <typename T>
Json or_null(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

void append_range(std::string& text, const drivers::hid::TrackerFeatures& features) {
    if (features.minimum_distance_m && features.maximum_distance_m) {
        fmt::format_to(std::back_inserter(text), "  distance  {:.2f} to {:.2f} m",
                       *features.minimum_distance_m, *features.maximum_distance_m);
        if (features.optimum_distance_m) {
            fmt::format_to(std::back_inserter(text), ", best {:.2f} m",
                           *features.optimum_distance_m);
        }
        text += "\n";
    }
}

}  // namespace

std::string devices_text(const std::vector<TrackerProbe>& probes) {
    if (probes.empty()) {
        return std::string(kNone);
    }
    std::string text;
    auto out = std::back_inserter(text);
    for (const TrackerProbe& probe : probes) {
        fmt::format_to(out, "{}\n  support   {}\n", probe.tracker.text(), kVerified);
        for (const std::string& remark : probe.remarks) {
            fmt::format_to(out, "  device    {}\n", remark);
        }
        append_range(text, probe.features);
        if (probe.seconds > 0.0) {
            fmt::format_to(out, "  samples   {} in {:.1f} s", probe.counts.samples, probe.seconds);
            if (probe.rate_hz) {
                fmt::format_to(out, " ({:.1f} Hz)", *probe.rate_hz);
            }
            if (probe.counts.samples > 0) {
                fmt::format_to(out, ", gaze in {}", percent(probe.with_gaze, probe.counts.samples));
            }
            text += "\n";
        }
        if (probe.clock) {
            fmt::format_to(out, "  {}\n", *probe.clock);
        } else if (probe.counts.samples > 0) {
            text += "  clock: none, it sends no timestamps: the age of the gaze is unknown\n";
        }
        for (const std::string& line : diagnosis(probe)) {
            fmt::format_to(out, "  PROBLEM   {}\n", line);
        }
    }
    return text;
}

Json devices_json(const std::vector<TrackerProbe>& probes) {
    Json list = Json::array();
    for (const TrackerProbe& probe : probes) {
        const drivers::hid::TrackerFeatures& features = probe.features;
        const bool clocked = probe.counts.samples > 0 && probe.clock;
        list.push_back(
            {{"source", "hid"},
             {"name", probe.tracker.name},
             {"path", probe.tracker.path},
             {"vendor", fmt::format("{:04x}", probe.tracker.vendor)},
             {"product", fmt::format("{:04x}", probe.tracker.product)},
             {"tried_on_hardware", false},
             {"accessible", !probe.tracker.access_problem.has_value()},
             {"udev_rule",
              probe.tracker.needs_rule
                  ? Json(drivers::hid::udev_rule(probe.tracker.vendor, probe.tracker.product))
                  : Json(nullptr)},
             {"status", features.status.status ? Json(std::string(text_of(*features.status.status)))
                                               : Json(nullptr)},
             {"stated_hz", or_null(features.status.sampling_hz)},
             {"screen_width_m", or_null(features.screen_width_m)},
             {"screen_height_m", or_null(features.screen_height_m)},
             {"minimum_distance_m", or_null(features.minimum_distance_m)},
             {"optimum_distance_m", or_null(features.optimum_distance_m)},
             {"maximum_distance_m", or_null(features.maximum_distance_m)},
             {"seconds", probe.seconds},
             {"samples", probe.counts.samples},
             {"samples_with_gaze", probe.with_gaze},
             {"samples_lost", probe.counts.lost},
             {"reports_truncated", probe.counts.truncated},
             {"measured_hz", or_null(probe.rate_hz)},
             {"clock", clocked ? Json(*probe.clock) : Json(nullptr)},
             {"remarks", probe.remarks},
             {"problems", diagnosis(probe)}});
    }
    return list;
}

bool any_gaze(const std::vector<TrackerProbe>& probes) {
    return std::ranges::any_of(probes,
                               [](const TrackerProbe& probe) { return probe.with_gaze > 0; });
}

}  // namespace gazeloop::cli
