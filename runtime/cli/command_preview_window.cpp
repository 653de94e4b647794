#include "runtime/cli/commands.h"
#include "runtime/preview/preview_window.h"

namespace gazeloop::cli {

void add_preview_window_command(Command program) {
    Command app = program.command(preview::kWindowCommand, "");
    app.hide();
    app.does([] { return preview::preview_window() == 0 ? ExitCode::Ok : ExitCode::NoDevice; });
}

}  // namespace gazeloop::cli
