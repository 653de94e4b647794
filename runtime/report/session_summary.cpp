#include "runtime/report/session_summary.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <charconv>
#include <optional>
#include <sstream>

namespace gazeloop::report {
namespace {

constexpr const char* kGlobal = "global";
constexpr const char* kRolling = "rolling";

std::optional<std::int64_t> meta_ns(const session::SessionFile& session, std::string_view name) {
    const auto text = session.meta(name);
    std::int64_t value = 0;
    if (!text ||
        std::from_chars(text->data(), text->data() + text->size(), value).ec != std::errc{}) {
        return std::nullopt;
    }
    return value;
}

}  // namespace

std::vector<NamedValue> meta_of(const display::DisplayProfile& display) {
    std::vector<NamedValue> meta{{"display", display.name},
                                 {"display_period_ns", fmt::format("{}", display.period_ns())}};
    const auto add_ns = [&](const char* name, const std::optional<std::int64_t>& ns) {
        if (ns) {
            meta.push_back({name, fmt::format("{}", *ns)});
        }
    };
    if (display.illumination) {
        meta.push_back(
            {"display_illumination",
             *display.illumination == display::Illumination::Global ? kGlobal : kRolling});
    }
    add_ns("display_persistence_ns", display.persistence_ns);
    add_ns("display_scan_out_ns", display.scan_out_ns);
    add_ns("display_switching_ns", display.switching_ns);
    if (!display.assumed.empty()) {
        meta.push_back({"display_assumed", fmt::format("{}", fmt::join(display.assumed, " "))});
    }
    return meta;
}

display::DisplayProfile recorded_display(const session::SessionFile& session) {
    display::DisplayProfile display;
    display.name = session.meta("display").value_or("");
    const std::int64_t period_ns = meta_ns(session, "display_period_ns").value_or(0);
    display.refresh_hz = period_ns > 0 ? 1e9 / static_cast<double>(period_ns) : 60.0;
    const auto illumination = session.meta("display_illumination");
    if (illumination == kGlobal) {
        display.illumination = display::Illumination::Global;
    } else if (illumination == kRolling) {
        display.illumination = display::Illumination::Rolling;
    }
    display.persistence_ns = meta_ns(session, "display_persistence_ns");
    display.scan_out_ns = meta_ns(session, "display_scan_out_ns");
    display.switching_ns = meta_ns(session, "display_switching_ns");
    std::istringstream assumed(std::string(session.meta("display_assumed").value_or("")));
    for (std::string key; assumed >> key;) {
        display.assumed.push_back(key);
    }
    return display;
}

latency::SummaryConfig summary_config(const display::DisplayProfile& display,
                                      latency::LoopClock clock) {
    return {.clock = clock,
            .period_ns = display.period_ns(),
            .switching_ns = display.switching_ns,
            .rolling_ns = display.rolling_ns(),
            .persistence_ns = display.persistence_ns,
            .assumed = display.assumed_photons()};
}

latency::SummaryConfig summary_config(const session::SessionFile& session) {
    latency::SummaryConfig config = summary_config(
        recorded_display(session), session.meta("clock") == "virtual" ? latency::LoopClock::Virtual
                                                                      : latency::LoopClock::Wall);
    config.period_ns = meta_ns(session, "display_period_ns").value_or(0);
    config.passes = session.header.passes;
    config.grids = session.header.grids;
    return config;
}

latency::SummaryReport summarize(const session::SessionFile& session) {
    latency::LatencySummary summary(summary_config(session));
    for (const session::RecordedSample& sample : session.samples) {
        summary.add(sample.sample);
    }
    for (const session::RecordedFrame& frame : session.frames) {
        if (frame.frame.period_ns > 0) {
            summary.set_display_period(frame.frame.period_ns);
        }
        summary.add(frame.frame);
        summary.add(frame.gpu);
    }
    return summary.report();
}

}  // namespace gazeloop::report
