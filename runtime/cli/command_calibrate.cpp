#include <fmt/core.h>
#include <pwd.h>
#include <unistd.h>

#include <cctype>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "drivers/rehearsal/rehearsal_source.h"
#include "runtime/calibrate/target_observer.h"
#include "runtime/calibration/calibration_file.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/gaze_run_options.h"
#include "runtime/environment.h"
#include "runtime/report/output_file.h"
#include "runtime/report/summary_json.h"

namespace gazeloop::cli {
namespace {

struct CalibrateCommand {
    GazeRunOptions run;
    calibration::TargetSchedule schedule;
    std::string user;
    std::string out;
    std::optional<unsigned> bad_point;
};

std::string login_name() {
    const passwd* const entry = getpwuid(geteuid());
    return entry != nullptr ? entry->pw_name : std::to_string(geteuid());
}

/// Of a file's name: what a shell or a folder would misread is left out.
std::string plain(std::string_view text) {
    std::string plain;
    for (const char c : text) {
        plain += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' ? c : '_';
    }
    return plain;
}

/// USER.SOURCE.toml in the user's data folder, which is made for its owner alone.
std::filesystem::path default_file(const std::string& user, std::string_view source) {
    const auto data = environment_value("XDG_DATA_HOME");
    const auto home = environment_value("HOME");
    if (!data && !home) {
        throw SetupError(ErrorKind::Usage,
                         "calibrate: neither XDG_DATA_HOME nor HOME is set: name the file with "
                         "--out FILE");
    }
    const std::filesystem::path folder =
        (data ? std::filesystem::path(*data) : std::filesystem::path(*home) / ".local" / "share") /
        "gazeloop" / "calibration";
    std::error_code error;
    if (std::filesystem::create_directories(folder, error)) {
        std::filesystem::permissions(folder, std::filesystem::perms::owner_all, error);
    }
    if (error) {
        throw SetupError(ErrorKind::BadInput,
                         fmt::format("{}: cannot be made: {}", folder.string(), error.message()));
    }
    return folder /
           fmt::format("{}.{}.toml", plain(user), plain(source.substr(0, source.find(':'))));
}

nlohmann::ordered_json json_of(const calibration::CalibrationResult& result,
                               const std::string& file) {
    nlohmann::ordered_json json{
        {"file", file.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(file)}};
    for (const gaze::Eye eye : gaze::kEyes) {
        const std::size_t i = gaze::index(eye);
        nlohmann::ordered_json of_eye{{"points", result.points[i].size()}};
        if (const auto& fit = result.eyes[i]) {
            nlohmann::ordered_json left_out = nlohmann::ordered_json::array();
            for (const std::size_t point : fit->left_out) {
                left_out.push_back(result.points[i][point] + 1);
            }
            of_eye["before_median_deg"] = fit->before_median_deg;
            of_eye["leave_one_out_median_deg"] = fit->leave_one_out_median_deg;
            of_eye["leave_one_out_greatest_deg"] = fit->leave_one_out_greatest_deg;
            of_eye["points_left_out"] = left_out;
        } else {
            of_eye["problem"] = result.problems[i];
        }
        json[std::string(gaze::kEyeNames[i])] = of_eye;
    }
    return json;
}

ExitCode calibrate(CalibrateCommand& command, const std::string& command_line) {
    run::ProgramSettings settings;
    auto request = command.run.prepare(settings, command_line);
    if (!request) {
        return ExitCode::Ok;
    }
    // What is measured is the tracker without a calibration, and points have no depth of the scene.
    value_or_throw(settings.set("gaze.calibration_values", "", "gazeloop calibrate"));
    value_or_throw(settings.set("render.depth", "false", "gazeloop calibrate"));
    const std::string user = command.user.empty() ? login_name() : command.user;
    const std::filesystem::path file = command.out.empty() ? default_file(user, command.run.gaze)
                                                           : std::filesystem::path(command.out);
    std::string device = command.run.gaze;
    if (command.run.gaze == "sim") {
        request->make_source = [&, simulation = settings.values().sim](std::int64_t start_ns) {
            return std::make_unique<drivers::RehearsalSource>(
                command.schedule, simulation,
                command.bad_point ? std::optional(std::size_t{*command.bad_point} - 1)
                                  : std::nullopt,
                start_ns);
        };
    } else if (command.bad_point) {
        throw SetupError(ErrorKind::Usage,
                         "--bad-point: only a simulated person (--gaze sim) can be "
                         "told to look aside");
    }
    const std::string& json = command.run.options.json;
    const bool quiet = command.run.options.log.quiet;
    request->json.reset();  // the calibration's own result goes there
    request->quiet = true;
    if (!json.empty()) {
        value_or_throw(report::check_output(json));
    }
    std::FILE* const out = json == "-" ? stderr : stdout;
    if (!quiet) {
        fmt::print(out,
                   "Look at the white dot until the next one appears, nine times, {:.0f} s in "
                   "all.\n",
                   command.schedule.length_s());
        std::fflush(out);
    }
    calibration::CalibrationSamples samples(command.schedule,
                                            settings.values().gaze.minimum_confidence);
    request->make_overlay = [&](const vulkan::Context& context,
                                const render::RendererConfig& config) {
        return std::make_unique<calibrate::TargetObserver>(context, config.frames_in_flight,
                                                           command.schedule, samples);
    };
    request->loop.end_with_source = false;
    request->loop.stop = [&samples]() -> std::optional<LoopEnd> {
        return samples.over() ? std::optional(LoopEnd::Limit) : std::nullopt;
    };
    if (const auto failure = run::frame_run(*request)) {
        return exit_code(failure);
    }
    const calibration::CalibrationResult result = calibration::result_of(samples);
    if (result.any()) {
        calibration::CalibrationFile made{
            .user = user, .device = command.run.gaze, .calibration = result.calibration()};
        for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
            if (result.eyes[eye]) {
                made.expected_error_deg[eye] = result.eyes[eye]->leave_one_out_median_deg;
            }
        }
        value_or_throw(calibration::write_calibration(made, file));
    }
    if (!quiet) {
        fmt::print(out, "{}", calibration::result_text(result));
        fmt::print(out, "{}",
                   result.any()
                       ? fmt::format("written to {}: --set gaze.calibration={} applies it\n",
                                     file.string(), file.string())
                       : std::string("nothing was written\n"));
    }
    if (!json.empty()) {
        value_or_throw(report::write_text(
            json, report::json_text(json_of(result, result.any() ? file.string() : ""))));
    }
    return result.any() ? ExitCode::Ok : ExitCode::GateFailed;
}

}  // namespace

void add_calibrate_command(Command program, const std::string& command_line) {
    Command app = program.command(
        "calibrate", "correct a tracker for one person: nine points to look at, a fit per eye");
    const auto command = std::make_shared<CalibrateCommand>();
    command->run.gaze = "hid";
    command->run.add_to(app);
    app.option("--user", command->user, "whose eyes they are (who is logged in)").type("NAME");
    app.option("--out", command->out,
               "where the calibration goes (USER.SOURCE.toml in the user's data folder)")
        .type("FILE");
    app.option("--point-seconds", command->schedule.shown_s, "how long each point is shown (1.6)")
        .type("S")
        .number_between(0.9, 60.0);
    app.option("--half-width", command->schedule.half_width_deg,
               "how far to the side the outer points lie, deg (15)")
        .type("DEG")
        .number_between(2.0, 45.0);
    app.option("--half-height", command->schedule.half_height_deg,
               "how far up and down the outer points lie, deg (10)")
        .type("DEG")
        .number_between(2.0, 45.0);
    app.option("--bad-point", command->bad_point,
               "with --gaze sim: look 8 deg beside this point, 1 to 9")
        .type("N")
        .number_between(1.0, 9.0);
    app.does([=] {
        command->run.options.log.apply();
        return calibrate(*command, command_line);
    });
}

}  // namespace gazeloop::cli
