#include "runtime/recordings/convert.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "drivers/trace/formats/angle_table.h"
#include "drivers/trace/native_trace.h"
#include "drivers/trace/text/text_output.h"
#include "runtime/recordings/recorded_gaze.h"
#include "runtime/recordings/recording_memory.h"
#include "runtime/report/gaze_report.h"
#include "runtime/report/output_file.h"
#include "runtime/report/summary_json.h"

namespace gazeloop::recordings {
namespace {

struct Written {
    std::vector<std::string> files;
    std::vector<std::string> left_out;
};

void check_table_output(const Conversion& conversion) {
    if (std::filesystem::is_directory(conversion.out)) {
        throw SetupError(
            ErrorKind::BadInput,
            fmt::format("{}: a directory: name a file in it, or --to bids", conversion.out));
    }
}

/// A table has what describes it beside it, and so may what is read.
void check_outputs(const Conversion& conversion) {
    const auto beside = [](const std::string& file) { return file + ".json"; };
    std::vector<report::NamedFile> outputs{{"the file to write", conversion.out},
                                           {"--json", conversion.json}};
    if (conversion.to == "gazeloop") {
        outputs.push_back({"what describes the file to write", beside(conversion.out)});
    }
    const std::array<report::NamedFile, 2> inputs{
        {{"the recording", conversion.in}, {"what describes it", beside(conversion.in)}}};
    value_or_throw(report::check_apart(outputs, inputs));
    // BIDS is a folder.
    const std::size_t folders = conversion.to == "bids" ? 1 : 0;
    value_or_throw(report::check_outputs(std::span{outputs}.subspan(folders), inputs));
}

/// What samples know beside directions, openness, confidence and head.
struct Besides {
    bool places = false;
    bool arrivals = false;
    bool parallax = false;
    bool covariances = false;
    std::uint64_t lost = 0;  ///< by the tracker, as the numbers of its samples say
    std::size_t untimed = 0;

    explicit Besides(const gaze::RecordingView& trace) {
        std::optional<std::uint64_t> before;
        for (const gaze::GazeSample& sample : trace.samples) {
            for (const gaze::EyeRay& ray : sample.eyes) {
                places = places || ray.origin_m != glm::dvec3{0.0};
                covariances = covariances || ray.covariance;
            }
            arrivals = arrivals || sample.arrived.known();
            parallax = parallax || sample.parallax_rad;
            untimed += sample.sampled.known() ? 0U : 1U;
            lost += before && sample.sequence > *before + 1 ? sample.sequence - *before - 1 : 0;
            before = sample.sequence;
        }
    }
};

/// What neither a table of angles nor BIDS has columns for.
std::vector<std::string> left_out_by_both(const Besides& besides) {
    std::vector<std::string> left_out;
    if (besides.arrivals) {
        left_out.emplace_back("when samples arrived");
    }
    if (besides.lost > 0) {
        left_out.push_back(
            fmt::format("the tracker's numbers of samples, by which it lost {}", besides.lost));
    }
    if (besides.covariances) {
        left_out.emplace_back("how far off the tracker says that directions may be");
    }
    if (besides.parallax) {
        left_out.emplace_back("how far off one ray for both eyes may be");
    }
    return left_out;
}

/// What a table of angles has no columns for.
std::vector<std::string> beside_angles(const Besides& besides) {
    std::vector<std::string> left_out = left_out_by_both(besides);
    if (besides.places) {
        left_out.emplace_back("each eye's place");
    }
    if (besides.untimed > 0) {
        left_out.push_back(fmt::format("{} samples whose time nobody knows", besides.untimed));
    }
    return left_out;
}

Written write(const Conversion& conversion, const gaze::RecordingView& trace) {
    if (conversion.to == "bids") {
        const drivers::WrittenBids bids =
            value_or_throw(drivers::write_bids(trace, conversion.out, conversion.labels));
        Written written{.files = {}, .left_out = bids.left_out};
        std::ranges::move(left_out_by_both(Besides(trace)), std::back_inserter(written.left_out));
        for (const std::filesystem::path& file : bids.files) {
            written.files.push_back(file.string());
        }
        return written;
    }
    check_table_output(conversion);
    if (conversion.to == "angles") {
        drivers::TextOutput out(conversion.out);
        drivers::write_angle_table(trace, out.stream());
        value_or_throw(out.close());
        return {{conversion.out}, beside_angles(Besides(trace))};
    }
    value_or_throw(drivers::write_native_trace(trace, conversion.out));
    return {{conversion.out, conversion.out + ".json"}, {}};
}

}  // namespace

void convert(const Conversion& conversion) {
    if (conversion.labelled && conversion.to != "bids") {
        throw SetupError(ErrorKind::Usage,
                         fmt::format("convert: --subject and --task label what is written as BIDS, "
                                     "not {}: add --to bids, or leave them out",
                                     conversion.to));
    }
    if (conversion.out == "-") {
        throw SetupError(ErrorKind::Usage,
                         "convert: '-' is no file: name one, or /dev/stdout for the table alone");
    }
    check_outputs(conversion);
    const RecordingMemory memory;
    const gaze::GazeRecording trace = recorded_gaze(conversion.in, conversion.read);
    memory.warn();
    const Written written = write(conversion, trace);
    if (conversion.json != "-") {
        std::string text = report::gaze_text(trace);
        for (const std::string& file : written.files) {
            text += fmt::format("wrote    {}\n", file);
        }
        for (const std::string& what : written.left_out) {
            text += fmt::format("left out {}\n", what);
        }
        value_or_throw(report::write_text("-", text));
    }
    if (!conversion.json.empty()) {
        nlohmann::ordered_json json = report::gaze_json(trace);
        json["written"] = {
            {"format", conversion.to}, {"files", written.files}, {"left_out", written.left_out}};
        value_or_throw(report::write_text(conversion.json, report::json_text(json)));
    }
}

}  // namespace gazeloop::recordings
