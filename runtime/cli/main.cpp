#include <fmt/ranges.h>
#include <poll.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <clocale>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "drivers/device/last_words.h"
#include "runtime/cli/commands.h"
#include "runtime/run/interrupt.h"
#include "runtime/version.h"

namespace {

using gazeloop::cli::ExitCode;

int code(ExitCode exit_code) { return static_cast<int>(exit_code); }

/// Whether stdout is a pipe or a socket whose reader has closed it.
bool reader_has_gone() {
    pollfd out{STDOUT_FILENO, POLLOUT, 0};
    return poll(&out, 1, 0) > 0 && (out.revents & POLLERR) != 0;
}

/// What becomes of a command whose stdout could not be written; `error` is errno's number, `result`
/// what it comes to otherwise. A reader who had enough (gazeloop ... | head) is told nothing: as
/// other programs do, this one ends by SIGPIPE.
int stdout_lost(int error, ExitCode result) {
    if (!reader_has_gone()) {
        spdlog::error(
            "stdout: cannot be written ({}): results are lost; free space, or name a file",
            std::strerror(error));
        return code(ExitCode::BadInput);
    }
    if (result == ExitCode::Ok) {
        std::signal(SIGPIPE, SIG_DFL);
        (void)std::raise(SIGPIPE);
    }
    return code(result);
}

int gazeloop_main(int count, char** arguments) {
    const auto log = spdlog::stderr_color_mt("gazeloop");
    log->set_pattern("%^%l%$: %v");
    spdlog::set_default_logger(log);
    gazeloop::drivers::set_last_words(
        [](std::string_view line) noexcept { spdlog::warn("{}", line); });
    // Writing to a closed pipe or past a file size limit is an error to deal with: it must not kill
    // before a recording is closed, or other results are written.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    gazeloop::run::end_when_interrupted();

    // Numbers are read and written with points, whatever the environment or a preloaded library
    // says.
    std::setlocale(LC_ALL, "C");

    try {
        const std::string command_line =
            fmt::format("{}", fmt::join(arguments, arguments + count, " "));
        gazeloop::cli::CommandLine line(
            "gazeloop", "An eye-tracked HMD runtime with a gaze-contingent frame loop");
        line.set_version(fmt::format("gazeloop {}", gazeloop::kVersion));
        gazeloop::cli::Command program = line.program();
        program.require_command();
        gazeloop::cli::add_run_command(program, command_line);
        gazeloop::cli::add_replay_command(program, command_line);
        gazeloop::cli::add_numerics_command(program);
        gazeloop::cli::add_calibrate_command(program, command_line);
        gazeloop::cli::add_probe_command(program, command_line);
        gazeloop::cli::add_report_command(program);
        gazeloop::cli::add_gaze_command(program);
        gazeloop::cli::add_convert_command(program);
        gazeloop::cli::add_plan_command(program);
        gazeloop::cli::add_compare_command(program);
        gazeloop::cli::add_trade_command(program, command_line);
        gazeloop::cli::add_simulate_command(program);
        gazeloop::cli::add_study_command(program, command_line);
        gazeloop::cli::add_devices_command(program);
        gazeloop::cli::add_doctor_command(program);
        gazeloop::cli::add_layer_command(program);
        gazeloop::cli::add_preview_window_command(program);
        const auto action =
            line.parse(std::vector<std::string>(arguments + std::min(count, 1), arguments + count));
        const ExitCode result = action ? (*action)() : gazeloop::cli::say(action.error());
        const bool lost = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
        return lost ? stdout_lost(errno, result) : code(result);
    } catch (const gazeloop::SetupError& error) {
        spdlog::error("{}", error.what());
        return code(gazeloop::cli::exit_code(error.kind()));
    } catch (const std::system_error& error) {
        if (std::ferror(stdout) == 0) {
            throw;
        }
        return stdout_lost(error.code().value(), ExitCode::Ok);
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
