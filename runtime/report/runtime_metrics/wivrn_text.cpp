#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include "runtime/report/runtime_metrics/covered_time.h"
#include "runtime/report/runtime_metrics/wivrn_stages.h"
#include "runtime/report/summary_json.h"

namespace gazeloop::report {
namespace {

using Json = nlohmann::ordered_json;

std::string cell(const std::optional<double>& ms) { return ms ? fmt::format("{:.2f}", *ms) : "-"; }

void append_row(std::string& text, std::string_view label, const latency::DurationRow& row) {
    fmt::format_to(std::back_inserter(text), "  {:<26}{:<11}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}\n",
                   label, time::name(row.kind()), row.count, cell(row.mean_ms), cell(row.p50_ms),
                   cell(row.p95_ms), cell(row.p99_ms), cell(row.max_ms));
}

void append_table(std::string& text, const WivrnStages& stages) {
    fmt::format_to(std::back_inserter(text), "  {:<26}{:<11}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}\n",
                   "milliseconds", "kind", "frames", "mean", "p50", "p95", "p99", "max");
    const std::size_t streams = stages.streams();
    for (std::size_t i = 0; i < kWivrnStages.size(); ++i) {
        const WivrnStage& stage = kWivrnStages[i];
        append_row(text, stage.label, stages.row(i));
        for (std::size_t stream = 0; stage.each_stream && streams > 1 && stream < streams;
             ++stream) {
            append_row(text, fmt::format("  stream {}", stream), stages.row(i, stream));
        }
    }
    append_row(text, "displayed after announced", stages.display_error());
}

void append_counts(std::string& text, const WivrnStages& stages) {
    const WivrnJoinCounts& counts = stages.counts();
    const WivrnFileCounts& file = stages.frames().file().counts();
    const auto line = [&text](std::uint64_t number, std::string_view what) {
        if (number > 0) {
            fmt::format_to(std::back_inserter(text), "  {}: {}\n", what, number);
        }
    };
    line(counts.missing, "not joined, nothing displayed within half a period");
    line(counts.taken, "not joined, what was displayed then is an earlier frame's");
    line(counts.too_early, "not joined, what was displayed then was encoded before");
    line(counts.not_announced, "not joined, no display time or period was announced");
    line(file.bad, fmt::format("rows of another form, the first in line {}", file.first_bad_line));
    line(file.unknown, "rows of events that are not known here");
    line(file.untimed, "rows without a time or a frame");
    line(stages.frames().other_streams(), "rows of more video streams than are kept apart");
    line(file.cut ? 1 : 0, "last row without an end, left out");
}

}  // namespace

std::string WivrnStages::text() const {
    std::string text = fmt::format(
        "WiVRn    {} of {} rendered frames joined by display time with its compositor's frames\n  "
        "{}\n",
        counts_.joined, counts_.frames, frames_.file().name());
    if (counts_.joined > 0) {
        append_table(text, *this);
        text +=
            "  The headset's clock is another one. WiVRn moves its times to the server's by a fit "
            "that\n"
            "  takes the way there and back for equally long: stages between the two (modelled) "
            "may be\n"
            "  off by half the difference. What is displayed when, the headset's runtime "
            "predicted.\n";
    } else if (counts_.frames > counts_.not_announced) {
        fmt::format_to(std::back_inserter(text),
                       "  The file has {}, the session {}: is it of this run?\n",
                       covered_time(frames_.first_ns(), frames_.last_ns()),
                       covered_time(counts_.first_ns, counts_.last_ns));
    }
    append_counts(text, *this);
    return text;
}

Json WivrnStages::json() const {
    Json stages = Json::object();
    const std::size_t streams = this->streams();
    for (std::size_t i = 0; i < kWivrnStages.size(); ++i) {
        Json stage = row_json(row(i));
        if (kWivrnStages[i].each_stream) {
            stage["streams"] = Json::array();
            for (std::size_t stream = 0; stream < streams; ++stream) {
                stage["streams"].push_back(row_json(row(i, stream)));
            }
        }
        stages[std::string(kWivrnStages[i].key)] = std::move(stage);
    }
    const WivrnFileCounts& file = frames_.file().counts();
    return {{"file", frames_.file().name()},
            {"frames",
             {{"rendered", counts_.frames},
              {"joined", counts_.joined},
              {"missing", counts_.missing},
              {"taken", counts_.taken},
              {"too_early", counts_.too_early},
              {"not_announced", counts_.not_announced}}},
            {"stages", stages},
            {"display_after_announced", row_json(display_error())},
            {"rows",
             {{"read", file.rows},
              {"unknown", file.unknown},
              {"untimed", file.untimed},
              {"bad", file.bad},
              {"first_bad_line", file.bad > 0 ? Json(file.first_bad_line) : Json(nullptr)},
              {"other_streams", frames_.other_streams()},
              {"cut", file.cut}}}};
}

}  // namespace gazeloop::report
