#include "drivers/psvr2/psvr2_source.h"

namespace gazeloop::drivers::psvr2 {

Psvr2Source::Psvr2Source(const Psvr2Options& options)
    : DeviceSource(
          {.subsystem = "usb",
           .thread_name = "gaze-psvr2",
           .absence = "no PlayStation VR2 is plugged in: waiting for one",
           .open = [options](const StopRequested&) { return open_any_headset(options); }}) {}

std::string Psvr2Source::description() const {
    return "PlayStation VR2 over USB (not tried on hardware)";
}

}  // namespace gazeloop::drivers::psvr2
