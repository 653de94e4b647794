#include "runtime/doctor/device_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

#include "drivers/device/sample_clock.h"
#include "runtime/doctor/openxr_gaze_report.h"

namespace gazeloop::doctor {
namespace {

using drivers::TrackerProbe;
using Json = nlohmann::ordered_json;

constexpr std::string_view kNone =
    "No eye tracker was found on HID or USB, and no eye service of a Steam Frame.\n"
    "  PlayStation VR2: none on USB. Is it plugged in, powered, and not asleep?\n"
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
    if (!probe.device.missing_rule.empty()) {
        lines.emplace_back(drivers::kRuleRemedy);
        lines.push_back("  " + probe.device.missing_rule);
    }
    if (probe.silence) {
        lines.push_back(*probe.silence);
    } else if (!probe.problem && probe.with_gaze == 0) {
        lines.emplace_back("it sends reports, but none with valid gaze");
    }
    if (probe.anatomy && probe.anatomy->doubtful()) {
        lines.push_back(gaze::anatomy_text(*probe.anatomy) +
                        "; calibrate the tracker anew, or correct its driver's axes");
    }
    return lines;
}

template <typename T>
Json or_null(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json hex_or_null(const std::optional<std::uint32_t>& value) {
    return value ? Json(fmt::format("{:04x}", *value)) : Json(nullptr);
}

Json id_or_null(const drivers::FoundDevice& device, std::uint16_t id) {
    return device.has_ids() ? Json(fmt::format("{:04x}", id)) : Json(nullptr);
}

/// What is meaningless until the fit has settled, or while its times are unusable, is null.
Json clock_json(const time::ClockFit& clock) {
    const time::ClockReading& last = clock.last();
    const bool usable = last.verdict != time::ClockVerdict::Unusable;
    const auto if_usable = [&](const auto value) { return usable ? Json(value) : Json(nullptr); };
    const auto verdict = static_cast<std::size_t>(last.verdict);
    const auto trouble = static_cast<std::size_t>(clock.trouble());
    const std::int64_t period_ns = clock.period_ns();
    return {{"verdict", time::kClockVerdictNames[verdict]},
            {"trouble", time::kClockTroubleNames[trouble]},
            {"uncertainty_ns", if_usable(last.uncertainty_ns)},
            {"host_minus_device_ns", if_usable(clock.offset_ns())},
            {"skew_ppm", if_usable(clock.skew_ppm())},
            {"mean_jitter_ns", if_usable(std::llround(clock.jitter_ns()))},
            {"period_ns", period_ns > 0 ? Json(period_ns) : Json(nullptr)},
            {"steps", clock.steps()}};
}

void append_capabilities(std::string& text, const drivers::TrackerFacts& facts) {
    if (facts.minimum_distance_m && facts.maximum_distance_m) {
        fmt::format_to(std::back_inserter(text), "  distance  {:.2f} to {:.2f} m",
                       *facts.minimum_distance_m, *facts.maximum_distance_m);
        if (facts.optimum_distance_m) {
            fmt::format_to(std::back_inserter(text), ", best {:.2f} m", *facts.optimum_distance_m);
        }
        text += "\n";
    }
    if (facts.maximum_screen_width_m && facts.maximum_screen_height_m) {
        fmt::format_to(std::back_inserter(text), "  screen    up to {:.0f} x {:.0f} mm\n",
                       *facts.maximum_screen_width_m * 1e3, *facts.maximum_screen_height_m * 1e3);
    }
    if (facts.quality) {
        fmt::format_to(std::back_inserter(text), "  quality   {} on a scale of its own\n",
                       *facts.quality);
    }
}

void append_pupils(std::string& text, const drivers::PupilsMm& pupils_mm) {
    const auto& [left, right] = pupils_mm;
    const auto one = [](const std::optional<double>& mm) {
        return mm ? fmt::format("{:.1f} mm", *mm) : std::string("unknown");
    };
    if (left || right) {
        fmt::format_to(std::back_inserter(text), "  pupils    {} left, {} right\n", one(left),
                       one(right));
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
        fmt::format_to(out, "{}\n  support   {}\n", probe.device.text(), probe.support.verified);
        for (const std::string& remark : probe.remarks) {
            fmt::format_to(out, "  device    {}\n", remark);
        }
        append_capabilities(text, probe.facts);
        if (probe.seconds > 0.0) {
            fmt::format_to(out, "  samples   {} in {:.1f} s", probe.counts.samples, probe.seconds);
            if (probe.rate_hz) {
                fmt::format_to(out, " ({:.1f} Hz)", *probe.rate_hz);
            }
            if (probe.counts.samples > 0) {
                fmt::format_to(out, ", gaze in {}", percent(probe.with_gaze, probe.counts.samples));
            }
            if (probe.counts.damaged > 0) {
                fmt::format_to(out, ", {} reports damaged", probe.counts.damaged);
            }
            if (probe.counts.lost > 0) {
                fmt::format_to(out, ", {} lost", probe.counts.lost);
            }
            text += "\n";
        }
        append_pupils(text, probe.pupils_mm);
        if (probe.anatomy && !probe.anatomy->doubtful()) {
            fmt::format_to(out, "  directions {}\n", gaze::anatomy_text(*probe.anatomy));
        }
        if (probe.clock) {
            fmt::format_to(out, "  {}\n", drivers::describe(*probe.clock));
        } else if (probe.counts.samples > 0) {
            text += "  clock: none, it sends no timestamps: the age of the gaze is unknown\n";
        }
        for (const std::string& line : diagnosis(probe)) {
            fmt::format_to(out, "  PROBLEM   {}\n", line);
        }
    }
    return text;
}

std::string devices_json(const std::vector<TrackerProbe>& probes, const Findings& openxr) {
    Json list = Json::array();
    for (const TrackerProbe& probe : probes) {
        const drivers::TrackerFacts& facts = probe.facts;
        const std::string& rule = probe.device.missing_rule;
        list.push_back({{"source", probe.support.source},
                        {"name", probe.device.name},
                        {"path", probe.device.path},
                        {"vendor", id_or_null(probe.device, probe.device.vendor)},
                        {"product", id_or_null(probe.device, probe.device.product)},
                        {"tried_on_hardware", false},
                        {"support", probe.support.verified},
                        {"accessible", !probe.device.access_problem.has_value()},
                        {"udev_rule", rule.empty() ? Json(nullptr) : Json(rule)},
                        {"status", or_null(facts.status)},
                        {"stated_hz", or_null(facts.sampling_hz)},
                        {"display_manufacturer", hex_or_null(facts.display_manufacturer)},
                        {"display_product", hex_or_null(facts.display_product)},
                        {"display_serial", or_null(facts.display_serial)},
                        {"screen_width_m", or_null(facts.screen_width_m)},
                        {"screen_height_m", or_null(facts.screen_height_m)},
                        {"quality", or_null(facts.quality)},
                        {"minimum_distance_m", or_null(facts.minimum_distance_m)},
                        {"optimum_distance_m", or_null(facts.optimum_distance_m)},
                        {"maximum_distance_m", or_null(facts.maximum_distance_m)},
                        {"maximum_screen_width_m", or_null(facts.maximum_screen_width_m)},
                        {"maximum_screen_height_m", or_null(facts.maximum_screen_height_m)},
                        {"unanswered_feature_reports", facts.unanswered_reports},
                        {"seconds", probe.seconds},
                        {"reports", probe.counts.reports},
                        {"samples", probe.counts.samples},
                        {"samples_with_gaze", probe.with_gaze},
                        {"samples_lost", probe.counts.lost},
                        {"reports_damaged", probe.counts.damaged},
                        {"measured_hz", or_null(probe.rate_hz)},
                        {"pupils_mm", {or_null(probe.pupils_mm[0]), or_null(probe.pupils_mm[1])}},
                        {"clock", probe.clock ? clock_json(*probe.clock) : Json(nullptr)},
                        {"directions",
                         probe.anatomy ? Json(gaze::anatomy_text(*probe.anatomy)) : Json(nullptr)},
                        {"remarks", probe.remarks},
                        {"problems", diagnosis(probe)}});
    }
    list.push_back(openxr_gaze_json(openxr));
    return list.dump(2, ' ', false, decltype(list)::error_handler_t::replace) + "\n";
}

bool any_gaze(const std::vector<TrackerProbe>& probes) {
    return std::ranges::any_of(probes,
                               [](const TrackerProbe& probe) { return probe.with_gaze > 0; });
}

}  // namespace gazeloop::doctor
