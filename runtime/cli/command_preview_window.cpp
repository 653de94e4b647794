#include "runtime/cli/commands.h"
#include "runtime/preview/preview_window.h"

namespace gazeloop::cli {

void add_preview_window_command(CLI::App& program, Action& action) {
    program.add_subcommand(preview::kWindowCommand)->group("")->callback([&action] {
        action = [] { return preview::preview_window() == 0 ? ExitCode::Ok : ExitCode::NoDevice; };
    });
}

}  // namespace gazeloop::cli
