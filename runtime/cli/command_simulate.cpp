#include "runtime/cli/commands.h"

namespace gazeloop::cli {

void add_simulate_command(Command program) {
    Command app = program.command("simulate", "make input without a device");
    app.require_command();
    add_simulate_tracker_command(app);
    add_simulate_steam_frame_command(app);
    add_simulate_light_field_command(app);
    add_simulate_gaze_command(app);
}

}  // namespace gazeloop::cli
