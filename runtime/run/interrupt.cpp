#include "runtime/run/interrupt.h"

#include <unistd.h>

#include <csignal>
#include <string_view>

#include "runtime/files/unfinished_files.h"

namespace gazeloop::run {
namespace {

volatile std::sig_atomic_t caught = 0;

void on_signal(int) { caught = 1; }

/// What an interrupted command ends with (ExitCode::Interrupted).
constexpr int kInterrupted = 130;

void end_at_once(int) {
    constexpr std::string_view kSaid = "error: interrupted\n";
    files::remove_unfinished_files();
    // There is nobody left to tell where it cannot be written.
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kSaid.data(), kSaid.size());
    ::_exit(kInterrupted);
}

void handle(void (*handler)(int), int flags) {
    struct sigaction action{};
    action.sa_handler = handler;
    action.sa_flags = flags;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

void catch_interrupts() { handle(on_signal, static_cast<int>(SA_RESETHAND | SA_RESTART)); }

bool interrupted() { return caught != 0; }

EndsWhenInterrupted::EndsWhenInterrupted() {
    handle(end_at_once, 0);
    if (interrupted()) {
        end_at_once(SIGINT);
    }
}

EndsWhenInterrupted::~EndsWhenInterrupted() { catch_interrupts(); }

}  // namespace gazeloop::run
