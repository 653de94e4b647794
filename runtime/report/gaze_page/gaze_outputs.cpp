#include "runtime/report/gaze_page/gaze_outputs.h"

#include <array>
#include <nlohmann/json.hpp>
#include <vector>

#include "runtime/report/gaze_comparison_text.h"
#include "runtime/report/gaze_events_text.h"
#include "runtime/report/gaze_report.h"
#include "runtime/report/output_file.h"
#include "runtime/report/summary_json.h"

namespace gazeloop::report {
namespace {

using Json = nlohmann::ordered_json;

Json recording_json(const page::PageRecording& recording) {
    Json json = gaze_json(recording.trace, recording.found);
    json["refused"] = recording.refused.empty() ? Json(nullptr) : Json(recording.refused);
    return json;
}

/// When the recording's times begin.
std::int64_t first_ns(const gaze::RecordingView& trace) {
    for (const gaze::GazeSample& sample : trace.samples) {
        if (sample.sampled.known()) {
            return sample.sampled.ns;
        }
    }
    return 0;
}

Expected<void> write_where_wanted(const std::string& file, const auto& text_of) {
    return file.empty() ? Expected<void>{} : write_text(file, text_of());
}

}  // namespace

Expected<void> check_outputs(const GazeOutputs& outputs, std::span<const std::string> recordings) {
    const std::array<NamedFile, 3> written{
        {{"--json", outputs.json}, {"--html", outputs.html}, {"--events", outputs.events}}};
    std::vector<NamedFile> read;
    for (const std::string& recording : recordings) {
        read.push_back({read.empty() ? "the recording" : "the other recording", recording});
    }
    if (read.size() > 1 && !outputs.events.empty()) {
        return std::unexpected(
            Error{ErrorKind::Usage, "--events is for one recording: leave the other out"});
    }
    return check_outputs(written, std::span<const NamedFile>(read));
}

Expected<void> write_gaze(const page::PageRecording& recording, const GazeOutputs& outputs) {
    if (auto done =
            write_where_wanted(outputs.json, [&] { return json_text(recording_json(recording)); });
        !done) {
        return done;
    }
    if (auto done = write_where_wanted(
            outputs.events,
            [&] { return events_csv(recording.found.events, first_ns(recording.trace)); });
        !done) {
        return done;
    }
    return write_where_wanted(outputs.html,
                              [&] { return page::gaze_page(std::span{&recording, 1}, nullptr); });
}

Expected<void> write_refusal(const std::string& file, const std::string& refusal,
                             const GazeOutputs& outputs) {
    return write_where_wanted(
        outputs.json, [&] { return json_text(Json{{"file", file}, {"refused", refusal}}); });
}

Expected<void> write_comparison(std::span<const page::PageRecording> recordings,
                                const gaze::GazeComparison& comparison,
                                const GazeOutputs& outputs) {
    const auto json = [&] {
        Json all{{"files", {recordings[0].trace.file, recordings[1].trace.file}},
                 {"comparison", gaze_comparison_json(comparison)},
                 {"recordings", Json::array()}};
        for (const page::PageRecording& recording : recordings) {
            all["recordings"].push_back(recording_json(recording));
        }
        return json_text(all);
    };
    if (auto done = write_where_wanted(outputs.json, json); !done) {
        return done;
    }
    return write_where_wanted(outputs.html,
                              [&] { return page::gaze_page(recordings, &comparison); });
}

}  // namespace gazeloop::report
