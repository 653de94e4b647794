#include "runtime/report/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <utility>

#include "runtime/latency/weakest_kind.h"
#include "runtime/report/session_rows.h"

namespace gazeloop::report {
namespace {

/// What a column knows, in the order of time, as it is shown.
std::vector<double> values_of(const DurationColumn& column) {
    std::vector<double> values;
    values.reserve(column.known());
    for (std::size_t row = 0; row < column.size(); ++row) {
        if (const auto number = column.at(row)) {
            values.push_back(shown(static_cast<double>(*number), column.unit()));
        }
    }
    return values;
}

bool reaches_the_display(std::string_view key) {
    return key == kGazeAgeAtDisplay.key || key == kHeldGazeAge.key;
}

/// Why one quantity of the two is not the same thing; empty: it is.
std::string refusal(const DurationColumn& before, const DurationColumn& after,
                    const latency::SummaryConfig& display_before,
                    const latency::SummaryConfig& display_after) {
    const time::StampKind kind_before = latency::weakest_kind(before.frames_by_kind());
    const time::StampKind kind_after = latency::weakest_kind(after.frames_by_kind());
    if (kind_before != kind_after) {
        return fmt::format("{} before, {} now", time::name(kind_before), time::name(kind_after));
    }
    if (!reaches_the_display(before.key())) {
        return {};
    }
    const auto lacking = [](bool known_before, bool known_after, std::string_view what) {
        return known_before == known_after
                   ? std::string{}
                   : fmt::format("{} is known {} alone", what, known_after ? "now" : "before");
    };
    const std::string switching =
        lacking(display_before.switching_ns.has_value(), display_after.switching_ns.has_value(),
                "the display's switching time");
    return !switching.empty()
               ? switching
               : lacking(display_before.rolling_ns.has_value(),
                         display_after.rolling_ns.has_value(), "when the display lights its rows");
}

ComparedRow row_of(const DurationColumn& before, const DurationColumn& after,
                   const latency::SummaryConfig& display_before,
                   const latency::SummaryConfig& display_after, const Percentiles& percentiles,
                   const statistics::BootstrapOptions& options) {
    ComparedRow row{.name = {after.key(), after.label()},
                    .unit = after.unit(),
                    .frames_before = before.known(),
                    .frames_after = after.known(),
                    .refused = refusal(before, after, display_before, display_after)};
    if (!row.refused.empty()) {
        return row;
    }
    const std::vector<double> values_before = values_of(before);
    const std::vector<double> values_after = values_of(after);
    row.mean = statistics::difference_of_means(values_before, values_after, options);
    for (const double percent : percentiles.percents()) {
        row.percentiles.push_back(
            statistics::difference_of_percentiles(values_before, values_after, percent, options));
    }
    return row;
}

void add_disparities(std::span<const NamedValue> before, std::span<const NamedValue> after,
                     std::vector<Disparity>& disparities) {
    for (const NamedValue& one : after) {
        const auto same = std::ranges::find(before, one.name, &NamedValue::name);
        const std::string value = same != before.end() ? same->value : std::string{};
        if (value != one.value) {
            disparities.push_back({one.name, value, one.value});
        }
    }
    for (const NamedValue& one : before) {
        if (std::ranges::find(after, one.name, &NamedValue::name) == after.end()) {
            disparities.push_back({one.name, one.value, {}});
        }
    }
}

std::vector<Disparity> disparities_of(const session::SessionHeader& before,
                                      const session::SessionHeader& after) {
    std::vector<Disparity> disparities;
    const auto add = [&disparities](std::string_view what, const std::string& was,
                                    const std::string& now) {
        if (was != now) {
            disparities.push_back({std::string(what), was, now});
        }
    };
    add("program", before.meta.program, after.meta.program);
    add("target", before.meta.target, after.meta.target);
    add("display", before.meta.display.name, after.meta.display.name);
    add_disparities(before.device, after.device, disparities);
    add_disparities(before.config, after.config, disparities);
    return disparities;
}

std::vector<std::string> doubts_of(const latency::SummaryReport& before,
                                   const latency::SummaryReport& after) {
    std::vector<std::string> doubts;
    for (const auto& [report, which] :
         {std::pair{&before, "the other"}, std::pair{&after, "this"}}) {
        if (report->verdict == latency::Verdict::NotRealTime) {
            doubts.push_back(fmt::format(
                "{} session was not real time: its ages are those of a loop that lags", which));
        }
    }
    if (!latency::may_be_of_period(before.config.period_ns, after.config.period_ns)) {
        doubts.push_back(fmt::format("the displays' periods differ: {:.2f} ms before, {:.2f} now",
                                     static_cast<double>(before.config.period_ns) * 1e-6,
                                     static_cast<double>(after.config.period_ns) * 1e-6));
    }
    return doubts;
}

std::string why_incomparable(const latency::SummaryReport& before,
                             const latency::SummaryReport& after) {
    const auto clock = [](const latency::SummaryReport& report) {
        return report.config.clock == latency::LoopClock::Virtual ? "ran in virtual time, modelled"
                                                                  : "was timed";
    };
    if (before.config.clock != after.config.clock) {
        return fmt::format("it {}, and this session {}", clock(before), clock(after));
    }
    if (before.gaze_age_at_latch.count == 0) {
        return "it has no frame whose gaze has a known age";
    }
    if (after.gaze_age_at_latch.count == 0) {
        return "this session has no frame whose gaze has a known age";
    }
    return {};
}

}  // namespace

bool ComparedRow::changed() const {
    const auto moved = [](const std::optional<statistics::Difference>& difference) {
        return difference && !difference->may_be_chance();
    };
    return moved(mean) || std::ranges::any_of(percentiles, moved);
}

Expected<Comparison> compare(const ComparedSession& before, const ComparedSession& after,
                             const Percentiles& percentiles,
                             const statistics::BootstrapOptions& options) {
    const latency::SummaryReport& report_before = before.summary.report;
    const latency::SummaryReport& report_after = after.summary.report;
    if (const std::string why = why_incomparable(report_before, report_after); !why.empty()) {
        return std::unexpected(Error{
            ErrorKind::BadInput,
            fmt::format("{}: cannot be compared with: {}", before.session.file().string(), why)});
    }
    auto path = fovea_path_difference(before.session, after.session);
    if (!path) {
        return std::unexpected(std::move(path.error()));
    }
    Comparison comparison{
        .options = options,
        .rows = {},
        .disparities = disparities_of(before.session.info().header, after.session.info().header),
        .doubts = doubts_of(report_before, report_after),
        .path = *path};
    for (const DurationColumn& column : after.summary.frames->columns()) {
        const DurationColumn* const other = before.summary.frames->column(column.key());
        if (other != nullptr && other->known() > 0 && column.known() > 0) {
            comparison.rows.push_back(row_of(*other, column, report_before.config,
                                             report_after.config, percentiles, options));
        }
    }
    return comparison;
}

}  // namespace gazeloop::report
