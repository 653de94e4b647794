#include "runtime/report/page/violations.h"

#include <algorithm>
#include <utility>

#include "runtime/report/row_names.h"

namespace gazeloop::report::page {
namespace {

bool longer(const ViolationRun& a, const ViolationRun& b) {
    return std::pair(a.frames, a.worst) > std::pair(b.frames, b.worst);
}

void keep_longest(std::vector<ViolationRun>& runs, std::size_t most) {
    std::ranges::stable_sort(runs, longer);
    runs.resize(std::min(runs.size(), most));
}

/// Whether a limit is about this frame: an age while the gaze is lost says how long it was, and not
/// what the chain of stages takes.
bool judged(const FrameLog& frames, const DurationColumn& column, std::size_t row) {
    const std::optional<gaze::FoveaState> state = frames.state(row);
    return state && (column.unit() == Unit::Count || *state == gaze::FoveaState::Tracking ||
                     *state == gaze::FoveaState::OtherEye);
}

Violations above(const FrameLog& frames, const RowName& name, std::int64_t limit,
                 std::size_t most_runs) {
    const DurationColumn& column = frames.at(name.key);
    Violations found{.label = name.label.substr(name.label.find_first_not_of(' ')),
                     .column = &column,
                     .limit = limit};
    std::optional<ViolationRun> run;
    const auto end_run = [&] {
        if (run) {
            ++found.all_runs;
            found.runs.push_back(*run);
            if (found.runs.size() >= 4 * (most_runs + 1)) {
                keep_longest(found.runs, most_runs);
            }
            run.reset();
        }
    };
    for (std::size_t row = 0; row < frames.rows(); ++row) {
        const std::optional<std::int64_t> number = column.at(row);
        if (!number) {
            if (!judged(frames, column, row)) {
                end_run();
            }
            continue;
        }
        ++found.known;
        if (*number <= limit) {
            end_run();
            continue;
        }
        ++found.frames;
        if (!run) {
            run = {.first = row, .last = row, .frames = 0, .worst = *number, .worst_row = row};
        }
        run->last = row;
        ++run->frames;
        if (*number > run->worst) {
            run->worst = *number;
            run->worst_row = row;
        }
    }
    end_run();
    keep_longest(found.runs, most_runs);
    return found;
}

}  // namespace

std::vector<Violations> violations(const FrameLog& frames, const latency::LatencyBudget* budget,
                                   std::size_t most_runs) {
    std::vector<Violations> all{above(frames, kPeriodsMissed, 0, most_runs)};
    if (budget == nullptr) {
        return all;
    }
    if (budget->total_ns) {
        all.push_back(above(frames, kGazeAgeAtDisplay, *budget->total_ns, most_runs));
    }
    for (std::size_t stage = 0; stage < latency::kStageCount; ++stage) {
        if (budget->stages_ns[stage]) {
            all.push_back(above(frames, stage_name(stage), *budget->stages_ns[stage], most_runs));
        }
    }
    return all;
}

}  // namespace gazeloop::report::page
