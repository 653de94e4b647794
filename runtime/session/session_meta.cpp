#include "runtime/session/session_meta.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string_view>

namespace gazeloop::session {
namespace {

constexpr std::string_view kProgram = "program";
constexpr std::string_view kCommandLine = "command_line";
constexpr std::string_view kStartedUtc = "started_utc";
constexpr std::string_view kClock = "clock";
constexpr std::string_view kTarget = "target";
constexpr std::string_view kTargetFormat = "target_format";
constexpr std::string_view kRuntimeMetrics = "runtime_metrics";
constexpr std::string_view kDisplay = "display";
constexpr std::string_view kPeriod = "display_period_ns";
constexpr std::string_view kIllumination = "display_illumination";
constexpr std::string_view kPersistence = "display_persistence_ns";
constexpr std::string_view kScanOut = "display_scan_out_ns";
constexpr std::string_view kSwitching = "display_switching_ns";
constexpr std::string_view kAssumed = "display_assumed";

// Values of kClock and kIllumination.
constexpr std::string_view kVirtual = "virtual";
constexpr std::string_view kWall = "wall";
constexpr std::string_view kGlobal = "global";
constexpr std::string_view kRolling = "rolling";

class Rows {
  public:
    void add(std::string_view name, std::string_view value) {
        if (!value.empty()) {
            rows_.push_back({std::string(name), std::string(value)});
        }
    }
    void add(std::string_view name, std::optional<std::int64_t> value) {
        if (value) {
            add(name, fmt::format("{}", *value));
        }
    }
    std::vector<NamedValue> take() { return std::move(rows_); }

  private:
    std::vector<NamedValue> rows_;
};

std::string_view text_in(std::span<const NamedValue> rows, std::string_view name) {
    const auto at = std::ranges::find(rows, name, &NamedValue::name);
    return at == rows.end() ? std::string_view{} : std::string_view{at->value};
}

std::optional<std::int64_t> ns_in(std::span<const NamedValue> rows, std::string_view name) {
    const std::string_view text = text_in(rows, name);
    std::int64_t value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} ? std::optional(value) : std::nullopt;
}

std::optional<display::Illumination> illumination_in(std::span<const NamedValue> rows) {
    const std::string_view text = text_in(rows, kIllumination);
    if (text == kGlobal) {
        return display::Illumination::Global;
    }
    return text == kRolling ? std::optional(display::Illumination::Rolling) : std::nullopt;
}

display::DisplayProfile display_in(std::span<const NamedValue> rows) {
    display::DisplayProfile display;
    display.name = text_in(rows, kDisplay);
    const std::int64_t period_ns = ns_in(rows, kPeriod).value_or(0);
    display.refresh_hz = period_ns > 0 ? 1e9 / static_cast<double>(period_ns) : 0.0;
    display.illumination = illumination_in(rows);
    display.persistence_ns = ns_in(rows, kPersistence);
    display.scan_out_ns = ns_in(rows, kScanOut);
    display.switching_ns = ns_in(rows, kSwitching);
    std::istringstream assumed{std::string(text_in(rows, kAssumed))};
    for (std::string key; assumed >> key;) {
        display.assumed.push_back(key);
    }
    return display;
}

}  // namespace

std::vector<NamedValue> rows_of(const SessionMeta& meta) {
    const display::DisplayProfile& display = meta.display;
    Rows rows;
    rows.add(kProgram, meta.program);
    rows.add(kCommandLine, meta.command_line);
    rows.add(kStartedUtc, meta.started_utc);
    rows.add(kClock, meta.clock == latency::LoopClock::Virtual ? kVirtual : kWall);
    rows.add(kTarget, meta.target);
    rows.add(kTargetFormat, meta.target_format);
    rows.add(kRuntimeMetrics, meta.runtime_metrics);
    rows.add(kDisplay, display.name);
    if (display.refresh_hz > 0.0) {
        rows.add(kPeriod, display.period_ns());
    }
    if (display.illumination) {
        rows.add(kIllumination,
                 *display.illumination == display::Illumination::Global ? kGlobal : kRolling);
    }
    rows.add(kPersistence, display.persistence_ns);
    rows.add(kScanOut, display.scan_out_ns);
    rows.add(kSwitching, display.switching_ns);
    rows.add(kAssumed, fmt::format("{}", fmt::join(display.assumed, " ")));
    return rows.take();
}

SessionMeta meta_of(std::span<const NamedValue> rows) {
    return {.program = std::string(text_in(rows, kProgram)),
            .command_line = std::string(text_in(rows, kCommandLine)),
            .started_utc = std::string(text_in(rows, kStartedUtc)),
            .clock = text_in(rows, kClock) == kVirtual ? latency::LoopClock::Virtual
                                                       : latency::LoopClock::Wall,
            .target = std::string(text_in(rows, kTarget)),
            .target_format = std::string(text_in(rows, kTargetFormat)),
            .runtime_metrics = std::string(text_in(rows, kRuntimeMetrics)),
            .display = display_in(rows)};
}

}  // namespace gazeloop::session
