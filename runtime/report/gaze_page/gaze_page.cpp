#include "runtime/report/gaze_page/gaze_page.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "runtime/gaze/sample_rate.h"
#include "runtime/report/gaze_comparison_text.h"
#include "runtime/report/gaze_page/gaze_figures.h"
#include "runtime/report/gaze_page/gaze_tables.h"
#include "runtime/report/gaze_report.h"
#include "runtime/report/page/page_parts.h"

namespace gazeloop::report::page {
namespace {

using Json = nlohmann::ordered_json;

std::string name_of(const gaze::RecordingView& trace) {
    return std::filesystem::path(trace.file).filename().string();
}

double percent(std::uint64_t part, std::size_t whole) {
    return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

/// The figures that a reader looks for first.
data key_figures(const gaze::RecordingView& trace, const GazeFindings& found) {
    data all = list();
    const auto add = [&all](const char* label, const std::string& value, const char* unit,
                            const std::string& more) {
        data item("label", label);
        item.set("value", value);
        item.set("unit", unit);
        item.set("more", more);
        all << item;
    };
    const double rate_hz = trace.rate_hz();
    add("Rate", rate_hz > 0.0 ? fmt::format("{:.4g}", rate_hz) : "unknown", "Hz",
        fmt::format("{} samples in {:.4g} s", trace.samples.size(), found.quality.duration_s));
    gaze::PerEye<std::uint64_t> seen{};
    for (const gaze::GazeSample& sample : trace.samples) {
        for (const gaze::Eye eye : gaze::kEyes) {
            seen[gaze::index(eye)] += sample.eyes[gaze::index(eye)].valid ? 1 : 0;
        }
    }
    add("Left eye seen in", fmt::format("{:.1f}", percent(seen[0], trace.samples.size())), "%",
        fmt::format("right eye in {:.1f} %", percent(seen[1], trace.samples.size())));
    const auto& precision =
        found.quality.precision[0] ? found.quality.precision[0] : found.quality.precision[1];
    add("Noise, sample to sample",
        precision ? fmt::format("{:.3f}", precision->sample_to_sample_deg) : "unknown", "deg",
        precision ? fmt::format("SD {:.3f} deg, {} eye", precision->deviation_deg,
                                found.quality.precision[0] ? "left" : "right")
                  : "no eye was seen for long enough");
    const gaze::EventStatistics& events = found.statistics;
    add("Saccades", fmt::format("{:.0f}", events.saccades.per_minute), "a minute",
        events.main_sequence ? fmt::format("peaks {:.2f} times the published ones",
                                           events.main_sequence->peak_over_published)
                             : "too few for a main sequence");
    return all;
}

data figures_data(std::vector<DrawnFigure>& figures, Json& drawn) {
    data all = list();
    for (DrawnFigure& figure : figures) {
        all << figure_data(figure.figure);
        drawn.push_back(std::move(figure.drawn));
    }
    return all;
}

data recording_data(const PageRecording& recording, std::size_t number, bool alone,
                    const std::string& name, Json& streams, Json& drawn) {
    const gaze::RecordingView& trace = recording.trace;
    const GazeBins bins = gaze_bins(trace.samples, recording.found.events);
    RecordingFigures figures =
        recording_figures(trace, recording.found, bins, number, streams.size());
    streams.push_back(stream_json(bins));
    data item("number", fmt::format("{}", number));
    item.set("name", alone ? "Recording" : name);
    if (!alone) {
        item.set("of", name);
    }
    if (!recording.refused.empty()) {
        item.set("refused", recording.refused);
    }
    item.set("key_figures", key_figures(trace, recording.found));
    item.set("text", gaze_text(trace, recording.found));
    item.set("over_time", figures_data(figures.over_time, drawn));
    item.set("precision", table_data(precision_table(recording.found)));
    item.set("accuracy", texts({"How far the gaze is off where the eye looked cannot be told from "
                                "the recording alone."}));
    item.set("accuracy_table", table_data({.heads = {{""}}, .rows = {}}));
    item.set("quality_figures", figures_data(figures.quality, drawn));
    item.set("events_note",
             "By the program's own event detector, which judges each sample with one that follows. "
             "Events at the begin and the end are in no duration. A blink is a loss of 100 to 400 "
             "ms.");
    item.set("event_table", table_data(event_kind_table(recording.found.statistics)));
    item.set("sequence_table", table_data(sequence_table(recording.found.statistics)));
    item.set("event_figures", figures_data(figures.events, drawn));
    return item;
}

data comparison_data(std::span<const PageRecording> recordings,
                     const gaze::GazeComparison& comparison, Json& streams, Json& drawn) {
    const GazeBins bins =
        compared_bins(recordings[0].trace.samples, recordings[1].trace.samples, comparison.lag_ms);
    std::vector<DrawnFigure> figures = comparison_figures(comparison, bins, streams.size());
    streams.push_back(stream_json(bins));
    data item;
    std::string lag = lag_text(comparison) + '.';
    lag.front() = 'T';
    item.set("lag", lag);
    if (comparison.doubtful()) {
        item.set("doubt", doubt_text());
    }
    item.set("agreement", table_data(agreement_table(comparison)));
    item.set("figures", figures_data(figures, drawn));
    return item;
}

}  // namespace

std::string gaze_page(std::span<const PageRecording> recordings,
                      const gaze::GazeComparison* comparison) {
    data page;
    add_style_and_scripts(page, {"numbers.js", "levels.js", "view.js", "charts.js", "plots.js",
                                 "shown_time.js", "gaze_plots.js"});
    const bool alone = recordings.size() == 1;
    std::string title;
    std::vector<std::string> names;
    for (const PageRecording& recording : recordings) {
        names.push_back(name_of(recording.trace));
        if (!alone && names.size() == 2 && names[0] == names[1]) {
            names = {recordings[0].trace.file, recordings[1].trace.file};
        }
    }
    for (const PageRecording& recording : recordings) {
        title += (title.empty() ? "" : " and ") + recording.trace.file;
    }
    page.set("title", title);
    Json streams = Json::array();
    Json drawn = Json::array();
    if (comparison != nullptr) {
        page.set("compared", comparison_data(recordings, *comparison, streams, drawn));
    }
    data all = list();
    for (std::size_t i = 0; i < recordings.size(); ++i) {
        all << recording_data(recordings[i], i + 1, alone, names[i], streams, drawn);
    }
    page.set("recordings", all);
    page.set("plot_data", script_json({{"streams", streams}, {"figures", drawn}}));
    return rendered("gaze.mustache", page);
}

}  // namespace gazeloop::report::page
