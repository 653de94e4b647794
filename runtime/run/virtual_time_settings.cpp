#include "runtime/run/virtual_time_settings.h"

namespace gazeloop::run {

std::vector<settings::SettingRow> rows_of(VirtualTimeSettings& virtual_time) {
    // A recording holds the times that came of it.
    return {{"virtual_time.gpu_ms", "modelled time on the GPU of a frame in virtual time",
             settings::Number{&virtual_time.gpu_ms, 0.0, 1000.0}, settings::Concerns::Input}};
}

}  // namespace gazeloop::run
