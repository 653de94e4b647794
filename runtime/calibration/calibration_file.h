#pragma once

#include <filesystem>
#include <string>

#include "runtime/calibration/calibration_fit.h"
#include "runtime/error.h"

namespace gazeloop::calibration {

/// What a calibration file says: of one person with one device.
struct CalibrationFile {
    std::string user;
    std::string device;  ///< as its gaze source describes itself
    Calibration calibration;
    gaze::PerEye<double> expected_error_deg{};  ///< median, leave one out; of calibrated eyes
};

/// TOML, read back to the same bits. Readable by its owner only (0600), for it is of a person.
/// Written as files::OutputFile writes. Errors (BadInput): it cannot be written.
[[nodiscard]] Expected<void> write_calibration(const CalibrationFile& calibration,
                                               const std::filesystem::path& file);

/// Errors (BadInput), with the file: it cannot be read or parsed, is larger than 64 KiB, of another
/// format or version, lacks a key, has a number out of range, or calibrates no eye.
[[nodiscard]] Expected<CalibrationFile> read_calibration(const std::filesystem::path& file);

}  // namespace gazeloop::calibration
