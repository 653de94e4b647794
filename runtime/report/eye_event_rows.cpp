#include "runtime/report/eye_event_rows.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "runtime/latency/weakest_kind.h"
#include "runtime/report/row_names.h"

namespace gazeloop::report {
namespace {

constexpr std::array<std::string_view, gaze::kEyeEventNames.size()> kLabels{
    "  in fixations", "  in saccades", "  in oscillations", "  in pursuit", "  while not seen"};

using Columns = std::vector<DurationColumn>;

Columns columns_of(Unit unit) {
    Columns columns;
    for (std::size_t event = 0; event < kLabels.size(); ++event) {
        columns.emplace_back(std::string(gaze::kEyeEventNames[event]), std::string(kLabels[event]),
                             unit);
    }
    return columns;
}

void add(DurationColumn& column, const DurationColumn& all, std::size_t row) {
    const std::optional<std::int64_t> number = all.at(row);
    column.add(number ? time::Span{*number, latency::weakest_kind(all.frames_by_kind())}
                      : time::Span{});
}

}  // namespace

EyeEventRows rows_by_eye_event(const FrameLog& frames, std::span<const double> percents) {
    EyeEventRows rows{.source = frames.eye_event_source(), .ages = {}, .errors = {}};
    const DurationColumn& ages = frames.at(kGazeAgeAtDisplay.key);
    const DurationColumn& errors = frames.at(kGazeError.key);
    Columns age_columns = columns_of(ages.unit());
    Columns error_columns = columns_of(errors.unit());
    for (std::size_t row = 0; row < frames.rows(); ++row) {
        const auto state = frames.state(row);
        if (state != gaze::FoveaState::Tracking && state != gaze::FoveaState::OtherEye) {
            continue;
        }
        ++rows.with_gaze;
        const auto event = frames.eye_event(row);
        if (!event) {
            ++rows.unknown;
            continue;
        }
        const std::size_t place = static_cast<std::size_t>(*event) - 1;
        add(age_columns[place], ages, row);
        add(error_columns[place], errors, row);
    }
    for (std::size_t event = 0; event < kLabels.size(); ++event) {
        if (age_columns[event].size() > 0) {
            rows.ages.push_back(row_of(age_columns[event], percents));
            rows.errors.push_back(row_of(error_columns[event], percents));
        }
    }
    return rows;
}

std::string source_text(const EyeEventRows& rows) {
    const std::string unknown = rows.unknown == 0 ? std::string{}
                                                  : fmt::format("; unknown in {} of {} frames",
                                                                rows.unknown, rows.with_gaze);
    switch (rows.source) {
        case EyeEventSource::Recorded:
            return "what the eyes did when the frame was shown, as the run told it" + unknown;
        case EyeEventSource::Found:
            return "what the eyes did when the frame was shown, found in the session's samples" +
                   unknown;
        case EyeEventSource::None:
            break;
    }
    return "what the eyes did is unknown";
}

}  // namespace gazeloop::report
