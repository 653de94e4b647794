#include "runtime/report/session_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "runtime/time/milliseconds.h"

namespace gazeloop::report {
namespace {

constexpr double kMicrodegreesPerDegree = 1e6;

/// Whether the quantity is shown even where no frame knows it: it is then unknown, not absent.
bool always_shown(std::string_view key) {
    for (std::size_t stage = 0; stage < latency::kStageCount; ++stage) {
        if (key == stage_name(stage).key) {
            return !latency::shown_only_if_known(stage);
        }
    }
    return key != kGazeAgeReadAtBegin.key && key != kGazeAgeUncertainty.key &&
           key != kHeldGazeAge.key && !key.starts_with("pass_");
}

std::optional<double> shown(const std::optional<std::int64_t>& number, Unit unit) {
    return number ? std::optional(shown(static_cast<double>(*number), unit)) : std::nullopt;
}

}  // namespace

double shown(double number, Unit unit) {
    switch (unit) {
        case Unit::Nanoseconds:
            return number / time::kNsPerMs;
        case Unit::Microdegrees:
            return number / kMicrodegreesPerDegree;
        case Unit::Count:
            break;
    }
    return number;
}

SessionRow row_of(const DurationColumn& column, std::span<const double> percents) {
    const Unit unit = column.unit();
    SessionRow row{.name = {column.key(), column.label()},
                   .unit = unit,
                   .known = column.known(),
                   .frames_by_kind = column.frames_by_kind(),
                   .negative = column.negative(),
                   .least = shown(column.least(), unit),
                   .mean = {},
                   .percentiles = {},
                   .greatest = shown(column.greatest(), unit)};
    if (const std::optional<double> mean = column.mean()) {
        row.mean = shown(*mean, unit);
    }
    std::ranges::transform(column.percentiles(percents), std::back_inserter(row.percentiles),
                           [unit](const auto& number) { return shown(number, unit); });
    return row;
}

std::vector<SessionRow> rows_of(const FrameLog& frames, std::span<const double> percents) {
    std::vector<SessionRow> rows;
    for (const DurationColumn& column : frames.columns()) {
        if (column.known() > 0 || always_shown(column.key())) {
            rows.push_back(row_of(column, percents));
        }
    }
    return rows;
}

std::vector<std::string> below_zero(const FrameLog& frames) {
    const std::string row_key = stage_name(static_cast<std::size_t>(latency::Stage::Row)).key;
    std::vector<std::string> sentences;
    for (const DurationColumn& column : frames.columns()) {
        if (column.negative() > 0 && column.key() != row_key) {
            const std::string& label = column.label();
            sentences.push_back(fmt::format(
                "Below 0: {} in {} of {} frames. A stamp or a clock is wrong there.",
                label.substr(label.find_first_not_of(' ')), column.negative(), column.known()));
        }
    }
    return sentences;
}

}  // namespace gazeloop::report
