#include "runtime/run/virtual_time_settings.h"

namespace gazeloop::run {

std::vector<settings::SettingRow> rows_of(VirtualTimeSettings& virtual_time) {
    // A recording keeps the times that result from it.
    return {{"virtual_time.gpu_ms", "GPU time of every frame in virtual time",
             settings::Number{&virtual_time.gpu_ms, 0.0, 1000.0}, settings::Concerns::Input}};
}

}  // namespace gazeloop::run
