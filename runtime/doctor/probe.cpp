#include "runtime/doctor/probe.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>

#include "runtime/error.h"

namespace gazeloop::doctor {
namespace {

constexpr std::size_t kOutputKept = 4096;
constexpr int kSliceMs = 50;

/// A pipe whose reading end never blocks.
struct Pipe {
    int read_end = -1;
    int write_end = -1;

    Pipe() {
        std::array<int, 2> ends{};
        if (pipe2(ends.data(), O_CLOEXEC) != 0) {
            throw SetupError(ErrorKind::NoDevice, fmt::format("no pipe ({}): close some programs",
                                                              std::strerror(errno)));
        }
        read_end = ends[0];
        write_end = ends[1];
        fcntl(read_end, F_SETFL, O_NONBLOCK);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    ~Pipe() {
        close(read_end);
        close_write_end();
    }
    void close_write_end() {
        if (write_end >= 0) {
            close(write_end);
            write_end = -1;
        }
    }
    /// Appends what is there.
    void drain_to(std::string& text) const {
        std::array<char, 4096> buffer{};
        for (ssize_t got = 0; (got = read(read_end, buffer.data(), buffer.size())) > 0;) {
            text.append(buffer.data(), static_cast<std::size_t>(got));
        }
    }
};

[[noreturn]] void be_probe(const std::function<void(ProbeReport&)>& probe, const Pipe& report,
                           const Pipe& output) {
    setpgid(0, 0);
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    std::signal(SIGPIPE, SIG_DFL);
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
    dup2(nothing, STDIN_FILENO);
    dup2(output.write_end, STDOUT_FILENO);
    dup2(output.write_end, STDERR_FILENO);
    ProbeReport to_parent(report.write_end);
    try {
        probe(to_parent);
        to_parent.ended();
    } catch (const std::exception& error) {
        to_parent.failed(error.what());
    }
    std::fflush(nullptr);
    // Without destructors: what a driver does at its end is not tested here.
    _exit(0);
}

/// Takes whole lines off the front of `text`.
void read_messages(std::string& text, ProbeResult& result, bool& ended) {
    for (std::size_t end = 0; (end = text.find('\n')) != std::string::npos;
         text.erase(0, end + 1)) {
        const nlohmann::json message =
            nlohmann::json::parse(text.substr(0, end), nullptr, /*allow_exceptions=*/false);
        if (!message.is_object()) {
            continue;
        }
        if (message.contains("step")) {
            result.step = message["step"];
            result.remedy = message["remedy"];
        } else if (message.contains("finding")) {
            result.findings.push_back(message["finding"]);
        } else if (message.contains("failed")) {
            result.broken = message["failed"];
            ended = true;
        } else {
            ended = true;
        }
    }
}

std::string last_line(std::string text) {
    text.erase(text.find_last_not_of(" \t\r\n") + 1);
    return text.substr(text.find_last_of('\n') + 1);
}

std::string how_it_ended(int status) {
    if (WIFSIGNALED(status)) {
        const char* const signal = sigabbrev_np(WTERMSIG(status));
        return fmt::format("crashed (SIG{})", signal != nullptr ? signal : "?");
    }
    return fmt::format("ended itself (exit code {})", WEXITSTATUS(status));
}

}  // namespace

void ProbeReport::send(const nlohmann::json& message) const {
    // Replaces what is not UTF-8: names come from drivers.
    const std::string line =
        message.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    for (std::size_t done = 0; done < line.size();) {
        const ssize_t wrote = write(pipe_, line.data() + done, line.size() - done);
        if (wrote <= 0) {
            return;  // the parent has given up on this probe
        }
        done += static_cast<std::size_t>(wrote);
    }
}

void ProbeReport::step(std::string_view what, std::string_view remedy) {
    send({{"step", what}, {"remedy", remedy}});
}
void ProbeReport::add(const Finding& finding) { send({{"finding", finding}}); }
void ProbeReport::failed(std::string_view why) { send({{"failed", why}}); }
void ProbeReport::ended() { send({{"ended", true}}); }

std::vector<Finding> ProbeResult::findings_and_end(std::string_view check,
                                                   std::string_view general_remedy,
                                                   bool stops_loop) && {
    if (!broken.empty()) {
        findings.push_back({.check = std::string(check),
                            .verdict = Verdict::Failure,
                            .found = step.empty() ? broken : fmt::format("{}: {}", step, broken),
                            .remedy = remedy.empty() ? std::string(general_remedy) : remedy,
                            .stops_loop = stops_loop});
    }
    return std::move(findings);
}

ProbeResult run_probe(const std::function<void(ProbeReport&)>& probe, const ProbeLimits& limits) {
    std::fflush(nullptr);
    Pipe report;
    Pipe output;
    const pid_t pid = fork();
    if (pid < 0) {
        throw SetupError(ErrorKind::NoDevice,
                         fmt::format("no process could be started ({})", std::strerror(errno)));
    }
    if (pid == 0) {
        be_probe(probe, report, output);
    }
    setpgid(pid, pid);  // parent and child both call it; either may be first
    report.close_write_end();
    output.close_write_end();

    ProbeResult result;
    std::string messages;
    std::string printed;
    bool ended = false;
    bool gone = false;
    int status = 0;
    const auto deadline = std::chrono::steady_clock::now() + limits.patience;
    while (!gone && !ended) {
        if (std::chrono::steady_clock::now() > deadline) {
            result.broken = fmt::format("hung: no end after {:.1f} s",
                                        std::chrono::duration<double>(limits.patience).count());
            break;
        }
        if (limits.stop()) {
            result.broken = "interrupted";
            break;
        }
        std::array<pollfd, 2> readable{pollfd{report.read_end, POLLIN, 0},
                                       pollfd{output.read_end, POLLIN, 0}};
        poll(readable.data(), readable.size(), kSliceMs);
        gone = waitpid(pid, &status, WNOHANG) == pid;
        report.drain_to(messages);
        output.drain_to(printed);
        if (printed.size() > kOutputKept) {
            printed.erase(0, printed.size() - kOutputKept);
        }
        read_messages(messages, result, ended);
    }
    if (gone && !ended) {
        result.broken = how_it_ended(status);
    }
    if (!result.broken.empty()) {
        // With everything that the runtime may have started.
        kill(-pid, SIGKILL);
        if (const std::string said = last_line(printed); !said.empty()) {
            result.broken += fmt::format("; its last words: {}", said);
        }
    }
    if (!gone) {
        waitpid(pid, nullptr, 0);
    }
    return result;
}

}  // namespace gazeloop::doctor
