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

void end_when_interrupted() { handle(end_at_once, 0); }

CatchesInterrupts::CatchesInterrupts() {
    handle(on_signal, static_cast<int>(SA_RESETHAND | SA_RESTART));
}

CatchesInterrupts::~CatchesInterrupts() { end_when_interrupted(); }

bool interrupted() { return caught != 0; }

}  // namespace gazeloop::run
