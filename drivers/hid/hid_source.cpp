#include "drivers/hid/hid_source.h"

namespace gazeloop::drivers::hid {
namespace {

DeviceKind kind_of(const HidOptions& options) {
    return {.subsystem = "hidraw",
            .thread_name = kHidThreadName,
            .absence = options.path.empty()
                           ? "no HID eye tracker is plugged in: waiting for one"
                           : options.path + " is no HID eye tracker: waiting for one",
            .open = [options](const StopRequested& stop) { return open_tracker(options, stop); }};
}

}  // namespace

HidSource::HidSource(const HidOptions& options)
    : DeviceSource(kind_of(options)), path_(options.path) {}

std::string HidSource::description() const {
    return "HID eye tracker (usage page 0x12)" + (path_.empty() ? "" : " at " + path_);
}

}  // namespace gazeloop::drivers::hid
