#include <fmt/core.h>

#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "drivers/trace/bids/write_bids.h"
#include "drivers/trace/formats/angle_table.h"
#include "drivers/trace/native_trace.h"
#include "drivers/trace/text/text_output.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/recorded_gaze.h"
#include "runtime/cli/run_options.h"
#include "runtime/report/gaze_report.h"
#include "runtime/report/output_file.h"
#include "runtime/report/summary_json.h"

namespace gazeloop::cli {
namespace {

struct ConvertCommand {
    LogOptions log;
    RecordedGazeOptions recorded;
    drivers::BidsLabels labels;
    std::string in;
    std::string out;
    std::string to = "gazeloop";
    std::string json;
};

struct Written {
    std::vector<std::string> files;
    std::vector<std::string> left_out;
};

void check_table_output(const ConvertCommand& command) {
    if (std::filesystem::is_directory(command.out)) {
        throw SetupError(
            ErrorKind::BadInput,
            fmt::format("{}: a directory: name a file in it, or --to bids", command.out));
    }
}

/// What a table of angles has no columns for.
std::vector<std::string> beside_angles(const gaze::GazeTrace& trace) {
    bool places = false;
    bool arrivals = false;
    std::size_t untimed = 0;
    for (const gaze::GazeSample& sample : trace.samples) {
        places = places || sample.eyes[0].origin_m != glm::dvec3{0.0} ||
                 sample.eyes[1].origin_m != glm::dvec3{0.0};
        arrivals = arrivals || sample.arrived.known();
        untimed += sample.sampled.known() ? 0U : 1U;
    }
    std::vector<std::string> left_out;
    if (places) {
        left_out.emplace_back("each eye's place");
    }
    if (arrivals) {
        left_out.emplace_back("when samples arrived");
    }
    if (untimed > 0) {
        left_out.push_back(fmt::format("{} samples whose time nobody knows", untimed));
    }
    return left_out;
}

Written write(const ConvertCommand& command, const gaze::GazeTrace& trace) {
    if (command.to == "bids") {
        const drivers::WrittenBids bids =
            value_or_throw(drivers::write_bids(trace, command.out, command.labels));
        Written written{.files = {}, .left_out = bids.left_out};
        for (const std::filesystem::path& file : bids.files) {
            written.files.push_back(file.string());
        }
        return written;
    }
    check_table_output(command);
    if (command.to == "angles") {
        drivers::TextOutput out(command.out);
        drivers::write_angle_table(trace, out.stream());
        value_or_throw(out.close());
        return {{command.out}, beside_angles(trace)};
    }
    value_or_throw(drivers::write_native_trace(trace, command.out));
    return {{command.out, command.out + ".json"}, {}};
}

ExitCode convert(const ConvertCommand& command) {
    if (!command.json.empty()) {
        value_or_throw(report::check_output(command.json));
    }
    const std::array<report::NamedFile, 2> outputs{
        {{"the file to write", command.out}, {"--json", command.json}}};
    const std::array<report::NamedFile, 1> inputs{{{"the recording", command.in}}};
    value_or_throw(report::check_apart(outputs, inputs));
    const gaze::GazeTrace trace = recorded_gaze(command.in, command.recorded);
    const Written written = write(command, trace);
    if (command.json != "-") {
        fmt::print("{}", report::gaze_text(trace));
        for (const std::string& file : written.files) {
            fmt::print("wrote    {}\n", file);
        }
        for (const std::string& what : written.left_out) {
            fmt::print("left out {}\n", what);
        }
    }
    if (!command.json.empty()) {
        nlohmann::ordered_json json = report::gaze_json(trace);
        json["written"] = {
            {"format", command.to}, {"files", written.files}, {"left_out", written.left_out}};
        value_or_throw(report::write_text(command.json, report::json_text(json)));
    }
    return ExitCode::Ok;
}

}  // namespace

void add_convert_command(Command program) {
    Command app =
        program.command("convert", "write a trace's or a session's gaze in another format");
    const auto command = std::make_shared<ConvertCommand>();
    app.option("in", command->in, "a trace, or a session written by --record")
        .required()
        .type("TRACE|SESSION");
    app.option("out", command->out, "a file, gzip if its name ends with .gz; bids: a folder")
        .required()
        .type("FILE|FOLDER");
    app.option("--to", command->to,
               "gazeloop: all that is known; angles: CSV of degrees; bids: BIDS 1.11 eye tracking")
        .one_of({"gazeloop", "angles", "bids"});
    app.option("--subject", command->labels.subject, "bids: the subject's label");
    app.option("--task", command->labels.task, "bids: the task's label");
    command->recorded.add_to(app);
    app.option("--json", command->json, "what was read and written; without a file, to stdout")
        .value_optional("-")
        .type("[FILE]");
    command->log.add_to(app);
    app.does([=] {
        command->log.apply();
        return convert(*command);
    });
}

}  // namespace gazeloop::cli
