#include "runtime/cli/commands.h"
#include "runtime/preview/preview_window.h"
#include "runtime/run/interrupt.h"

namespace gazeloop::cli {

void add_preview_window_command(Command program) {
    Command app = program.command(preview::kWindowCommand, "");
    app.hide();
    app.does([] {
        const run::CatchesInterrupts catches;  // the loop closes the window
        return preview::preview_window() == 0 ? ExitCode::Ok : ExitCode::NoDevice;
    });
}

}  // namespace gazeloop::cli
