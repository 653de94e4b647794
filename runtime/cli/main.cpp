#include <fmt/core.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <clocale>
#include <csignal>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "runtime/cli/commands.h"
#include "runtime/run/interrupt.h"
#include "runtime/settings/nearest_name.h"
#include "runtime/version.h"

namespace {

using gazeloop::cli::ExitCode;

std::string joined(int count, char** arguments) {
    std::string line;
    for (int i = 0; i < count; ++i) {
        line += fmt::format("{}{}", i > 0 ? " " : "", arguments[i]);
    }
    return line;
}

int code(ExitCode exit_code) { return static_cast<int>(exit_code); }

/// CLI11 does not say which word it could not place.
std::optional<std::string> unknown_command(const CLI::App& program, int count, char** arguments) {
    if (count < 2 || arguments[1][0] == '-') {
        return std::nullopt;
    }
    std::vector<std::string> known;
    for (const CLI::App* const command : program.get_subcommands({})) {
        if (command->get_name() == arguments[1]) {
            return std::nullopt;
        }
        if (!command->get_group().empty()) {  // what has none is the program's own
            known.push_back(command->get_name());
        }
    }
    return gazeloop::settings::unknown_name("command", arguments[1], known);
}

/// Of what was left over after parsing; CLI11 lists it from the end, without saying what is near.
std::string unexpected_word(const CLI::App& program, int count, char** arguments) {
    const CLI::App* command = &program;
    std::string name = program.get_name();
    while (!command->get_subcommands().empty()) {
        command = command->get_subcommands().front();
        name += " " + command->get_name();
    }
    std::vector<std::string> known;
    for (const CLI::Option* const option : command->get_options()) {
        for (const std::string& one : option->get_lnames()) {
            known.push_back("--" + one);
        }
    }
    const std::string help = fmt::format("{} --help lists what there is", name);
    for (int i = 1; i < count; ++i) {
        const std::string word =
            std::string(arguments[i]).substr(0, std::string(arguments[i]).find('='));
        if (word.starts_with("--") && std::ranges::find(known, word) == known.end()) {
            const auto nearest = gazeloop::settings::nearest_name(word, known);
            return fmt::format("unknown option '{}'{}; {}", word,
                               nearest ? fmt::format("; did you mean '{}'?", *nearest) : "", help);
        }
    }
    const std::vector<std::string> left = command->remaining();
    return fmt::format("'{}' was not expected; {}", left.empty() ? "" : left.front(), help);
}

int gazeloop_main(int count, char** arguments) {
    const auto log = spdlog::stderr_color_mt("gazeloop");
    log->set_pattern("%^%l%$: %v");
    spdlog::set_default_logger(log);
    // Writing to a closed pipe or past a file size limit is an error to report, not a death.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    gazeloop::run::catch_interrupts();

    // Numbers are read and written with points, whatever the environment or a preloaded library
    // says.
    std::setlocale(LC_ALL, "C");

    CLI::App program("An eye-tracked HMD runtime with a gaze-contingent frame loop", "gazeloop");
    program.set_version_flag("--version", fmt::format("gazeloop {}", gazeloop::kVersion));
    program.require_subcommand(1);
    gazeloop::cli::Action action;
    const std::string command_line = joined(count, arguments);
    gazeloop::cli::add_run_command(program, command_line, action);
    gazeloop::cli::add_replay_command(program, command_line, action);
    gazeloop::cli::add_numerics_command(program, action);
    gazeloop::cli::add_report_command(program, action);
    gazeloop::cli::add_plan_command(program, action);
    gazeloop::cli::add_simulate_command(program, action);
    gazeloop::cli::add_devices_command(program, action);
    gazeloop::cli::add_doctor_command(program, action);
    gazeloop::cli::add_preview_window_command(program, action);
    if (const auto refusal = unknown_command(program, count, arguments)) {
        spdlog::error("{}", *refusal);
        return code(ExitCode::Usage);
    }
    try {
        program.parse(count, arguments);
    } catch (const CLI::ExtrasError&) {
        spdlog::error("{}", unexpected_word(program, count, arguments));
        return code(ExitCode::Usage);
    } catch (const CLI::ParseError& error) {
        return program.exit(error) == 0 ? code(ExitCode::Ok) : code(ExitCode::Usage);
    }
    try {
        const ExitCode result = action();
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
            spdlog::error("stdout cannot be written: the results are lost");
            return code(ExitCode::BadInput);
        }
        return code(result);
    } catch (const gazeloop::SetupError& error) {
        spdlog::error("{}", error.what());
        return code(gazeloop::cli::exit_code(error.kind()));
    } catch (const std::bad_alloc&) {
        spdlog::error("out of memory: use a smaller picture (--set render.scale=0.5) or trace");
        return code(ExitCode::NoDevice);
    }
}

}  // namespace

int main(int count, char** arguments) {
    try {
        return gazeloop_main(count, arguments);
    } catch (const std::exception& error) {
        fmt::print(stderr, "error: {}\n", error.what());
        return code(ExitCode::SessionLost);
    }
}
