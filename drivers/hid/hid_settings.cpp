#include "drivers/hid/hid_settings.h"

namespace gazeloop::drivers::hid {

std::vector<settings::SettingRow> rows_of(HidSettings& hid) {
    using settings::Concerns;
    using settings::Number;
    return {
        {"hid.eye_distance_m",
         "HID tracker: distance between the eyes where it does not see both, m",
         Number{&hid.eye_distance_m, 0.0, 0.2}, Concerns::Input},
        {"hid.screen_height_m", "HID tracker: height of its screen, m; 0: what it states",
         Number{&hid.screen_height_m, 0.0, 100.0}, Concerns::Input},
        {"hid.screen_width_m", "HID tracker: width of its screen, m; 0: what it states",
         Number{&hid.screen_width_m, 0.0, 100.0}, Concerns::Input},
        {"hid.viewing_distance_m",
         "HID tracker: distance from eyes to screen where it does not see them, m; 0: unknown",
         Number{&hid.viewing_distance_m, 0.0, 100.0}, Concerns::Input},
    };
}

}  // namespace gazeloop::drivers::hid
