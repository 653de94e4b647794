#include "runtime/calibration/calibration_settings.h"

#include <spdlog/spdlog.h>

#include <string>
#include <utility>

#include "runtime/calibration/calibration_file.h"

namespace gazeloop::calibration {

Expected<void> take_calibration(const std::string& file, settings::Settings& all) {
    if (file.empty()) {
        return {};
    }
    const auto read = all.at_origin("gaze.calibration", read_calibration(file));
    if (!read) {
        return std::unexpected(read.error());
    }
    spdlog::info("calibration: of {} with {}", read->user.empty() ? "somebody" : read->user,
                 read->device.empty() ? "an unknown device" : read->device);
    for (const auto& [key, text] :
         {std::pair{"gaze.calibration_values", values_text(read->calibration)},
          std::pair{"gaze.calibration_device", read->device}}) {
        if (auto set = all.set(key, text, file); !set) {
            return set;
        }
    }
    return all.set("gaze.calibration", "", "taken");
}

Expected<std::optional<Calibration>> calibration_in_force(const std::string& values,
                                                          const settings::Settings& all) {
    if (values.empty()) {
        return std::nullopt;
    }
    auto read = all.at_origin("gaze.calibration_values", read_values(values));
    if (!read) {
        return std::unexpected(std::move(read.error()));
    }
    return std::optional(*read);
}

}  // namespace gazeloop::calibration
