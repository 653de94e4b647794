#include "runtime/report/page/plot_data.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "runtime/report/page/page_parts.h"
#include "runtime/report/page/page_tables.h"
#include "runtime/report/row_names.h"
#include "runtime/report/session_rows.h"
#include "runtime/time/milliseconds.h"
#include "runtime/time/span.h"

namespace gazeloop::report::page {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostMarks = 500;  ///< of a kind of events on the time line

std::string of_series(PlotForm form) { return form == PlotForm::Mean ? "mean" : "envelope"; }

std::string label_of(const DurationColumn& column) {
    const std::string& label = column.label();
    return label.substr(std::min(label.find_first_not_of(' '), label.size()));
}

Json distribution_json(const Distribution& one) {
    return {{"first_ms", shown(static_cast<double>(one.first), Unit::Nanoseconds)},
            {"width_ms", shown(static_cast<double>(one.width), Unit::Nanoseconds)},
            {"frames", one.frames},
            {"above", one.above},
            {"known", one.known}};
}

/// Events that lie as close together as a wide screen cannot show are one mark.
Json marks_json(const EventLine::Kind& kind, std::int64_t first_ns, double end_s) {
    std::vector<double> seconds;
    seconds.reserve(kind.ns.size());
    for (const std::int64_t ns : kind.ns) {
        seconds.push_back(
            static_cast<double>(time::saturated(static_cast<__int128>(ns) - first_ns)) * 1e-9);
    }
    std::ranges::sort(seconds);
    const double apart =
        seconds.size() > kMostMarks
            ? std::max(end_s, seconds.back() - seconds.front()) / static_cast<double>(kMostMarks)
            : 0.0;
    Json marks = Json::array();
    for (const double at : seconds) {
        if (!marks.empty() && at - marks.back()[0].get<double>() < apart) {
            marks.back()[1] = marks.back()[1].get<std::uint64_t>() + 1;
        } else {
            marks.push_back({at, std::uint64_t{1}});
        }
    }
    return marks;
}

Json packed_json(const PackedBins& bins) { return {{"bins", bins.bins}, {"data", bins.data}}; }

}  // namespace

std::string plot_data(const PageContents& contents, const FramePlots& plots,
                      std::span<const Violations> limits,
                      std::span<const Distribution> at_latch_and_display) {
    const FrameLog& frames = *contents.session.frames;
    Json series = Json::array();
    for (const PlotSeries& one : plots.series) {
        const DurationColumn& column = frames.at(one.key);
        series.push_back({{"key", one.key},
                          {"label", label_of(column)},
                          {"form", of_series(one.form)},
                          {"unit", column.unit() == Unit::Microdegrees ? "deg" : "ms"}});
    }
    Json limits_json = Json::array();
    for (const Violations& one : limits) {
        limits_json.push_back(
            {{"key", one.column->key()},
             {"label", one.label},
             {"ms", one.column->unit() == Unit::Nanoseconds
                        ? Json(shown(static_cast<double>(one.limit), Unit::Nanoseconds))
                        : Json(nullptr)}});
    }
    Json spans = Json::array();
    for (const RowSpan& span : plots.spans) {
        spans.push_back({span.first, span.end});
    }
    Json events = Json::array();
    const std::optional<std::int64_t> first = first_wake_up_ns(frames);
    const double end_s = static_cast<double>(plots.end) * 1e-5;
    for (const EventLine::Kind& kind : contents.events.kinds()) {
        if (first && !kind.ns.empty()) {
            events.push_back({{"kind", kind.name}, {"marks", marks_json(kind, *first, end_s)}});
        }
    }
    const latency::SummaryConfig& config = contents.session.report.config;
    const Json json{{"rows", plots.rows},
                    {"end", plots.end},
                    {"time_known", plots.time_known},
                    {"period_ms", config.period_ns > 0
                                      ? Json(static_cast<double>(config.period_ns) / time::kNsPerMs)
                                      : Json(nullptr)},
                    {"series", std::move(series)},
                    {"limits", std::move(limits_json)},
                    {"all", packed_json(plots.all)},
                    {"spans", std::move(spans)},
                    {"single", packed_json(plots.single)},
                    {"latch", distribution_json(at_latch_and_display[0])},
                    {"display", distribution_json(at_latch_and_display[1])},
                    {"events", std::move(events)}};
    return script_json(json);
}

}  // namespace gazeloop::report::page
