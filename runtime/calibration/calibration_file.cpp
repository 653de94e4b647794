#include "runtime/calibration/calibration_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "runtime/files/output_file.h"
#include "runtime/open_for_reading.h"

namespace gazeloop::calibration {
namespace {

constexpr std::string_view kFormat = "gazeloop-calibration";
constexpr std::int64_t kVersion = 1;
constexpr std::size_t kLargestFile = 64 * 1024;

/// As a TOML string: what could end it or its line is escaped.
std::string toml_text(std::string_view text) {
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            quoted += '\\';
            quoted += c;
        } else if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') {
            quoted += ' ';
        } else {
            quoted += c;
        }
    }
    return quoted + '"';
}

/// Numbers that TOML takes for real ones, in the fewest digits that are read back to the same bits.
std::string reals(std::span<const double> values) {
    std::vector<std::string> texts;
    for (const double value : values) {
        std::string text = fmt::format("{}", value);
        if (text.find_first_of(".e") == std::string::npos) {
            text += ".0";
        }
        texts.push_back(std::move(text));
    }
    return fmt::format("{}", fmt::join(texts, ", "));
}

std::string text_of(const CalibrationFile& file) {
    std::string eyes;
    for (const gaze::Eye eye : gaze::kEyes) {
        if (file.calibration[gaze::index(eye)]) {
            eyes += fmt::format("{}\"{}\"", eyes.empty() ? "" : ", ",
                                gaze::kEyeNames[gaze::index(eye)]);
        }
    }
    std::string text = fmt::format(
        "# Made by gazeloop calibrate; --set gaze.calibration=FILE applies it.\n"
        "# What is added to azimuth (right) and elevation (up), radians: coefficients of\n"
        "# 1, x, y, x^2, xy, y^2 of azimuth x and elevation y. Held constant beyond the reach.\n"
        "format = \"{}\"\nversion = {}\nuser = {}\ndevice = {}\neyes = [{}]\n",
        kFormat, kVersion, toml_text(file.user), toml_text(file.device), eyes);
    for (const gaze::Eye eye : gaze::kEyes) {
        if (const auto& of_eye = file.calibration[gaze::index(eye)]) {
            text += fmt::format(
                "\n[{}]\nazimuth = [{}]\nelevation = [{}]\nreach_rad = {}\n"
                "expected_error_deg = {}\n",
                gaze::kEyeNames[gaze::index(eye)], reals(of_eye->azimuth), reals(of_eye->elevation),
                reals({&of_eye->reach_rad, 1}),
                reals({&file.expected_error_deg[gaze::index(eye)], 1}));
        }
    }
    return text;
}

std::unexpected<Error> bad(const std::filesystem::path& file, const std::string& what) {
    return std::unexpected(Error{ErrorKind::BadInput, fmt::format("{}: {}", file.string(), what)});
}

/// Six numbers under that key; false where there are not.
bool read_coefficients(const toml::table& table, std::string_view key,
                       std::array<double, kTerms>& coefficients) {
    const toml::array* const array = table[key].as_array();
    if (array == nullptr || array->size() != kTerms) {
        return false;
    }
    for (std::size_t i = 0; i < kTerms; ++i) {
        const auto value = (*array)[i].value<double>();
        if (!value) {
            return false;
        }
        coefficients[i] = *value;
    }
    return true;
}

}  // namespace

Expected<void> write_calibration(const CalibrationFile& calibration,
                                 const std::filesystem::path& file) {
    return files::write_text(file, text_of(calibration), files::kOwnerOnly);
}

Expected<CalibrationFile> read_calibration(const std::filesystem::path& file) {
    auto in = open_for_reading(file);
    if (!in) {
        return bad(file, fmt::format("the calibration cannot be read ({})", in.error()));
    }
    std::string text(kLargestFile + 1, '\0');
    in->read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in->gcount()));
    if (text.size() > kLargestFile) {
        return bad(file, "is larger than any calibration (64 KiB)");
    }
    toml::table table;
    try {
        table = toml::parse(text, file.string());
    } catch (const toml::parse_error& error) {
        return bad(file,
                   fmt::format("line {}: {}", error.source().begin.line, error.description()));
    }
    if (table["format"].value<std::string>() != kFormat ||
        table["version"].value<std::int64_t>() != kVersion) {
        return bad(file, fmt::format("is no calibration: format = \"{}\" and version = {} are "
                                     "missing",
                                     kFormat, kVersion));
    }
    // Every line is ended as it is written: a file that was cut inside a number would still be
    // read.
    if (!text.ends_with('\n')) {
        return bad(file,
                   "is cut short: its last line has no end; copy it again, or calibrate anew");
    }
    CalibrationFile result{.user = table["user"].value_or(std::string()),
                           .device = table["device"].value_or(std::string()),
                           .calibration = {}};
    for (const gaze::Eye eye : gaze::kEyes) {
        const std::string_view name = gaze::kEyeNames[gaze::index(eye)];
        const toml::table* const of_eye = table[name].as_table();
        if (of_eye == nullptr) {
            continue;
        }
        EyeCalibration& stored = result.calibration[gaze::index(eye)].emplace();
        const auto reach = (*of_eye)["reach_rad"].value<double>();
        if (!read_coefficients(*of_eye, "azimuth", stored.azimuth) ||
            !read_coefficients(*of_eye, "elevation", stored.elevation) || !reach ||
            !(*reach > 0.0)) {
            return bad(file, fmt::format("[{}] needs azimuth and elevation, {} numbers each, and "
                                         "reach_rad above 0",
                                         name, kTerms));
        }
        stored.reach_rad = *reach;
        const auto error = (*of_eye)["expected_error_deg"].value<double>();
        if (!error) {
            return bad(file,
                       fmt::format("[{}] lacks expected_error_deg, its last line: the file is "
                                   "cut short; copy it again, or calibrate anew",
                                   name));
        }
        result.expected_error_deg[gaze::index(eye)] = *error;
    }
    if (const toml::array* const eyes = table["eyes"].as_array()) {
        for (const gaze::Eye eye : gaze::kEyes) {
            const bool promised = std::ranges::any_of(*eyes, [&](const toml::node& one) {
                return one.value<std::string>() == gaze::kEyeNames[gaze::index(eye)];
            });
            if (promised && !result.calibration[gaze::index(eye)]) {
                return bad(file, fmt::format("lacks [{}], which its line 'eyes' names: it is cut "
                                             "short; copy it again, or calibrate anew",
                                             gaze::kEyeNames[gaze::index(eye)]));
            }
        }
    }
    if (!result.calibration[0] && !result.calibration[1]) {
        return bad(file, "calibrates no eye: it has neither [left] nor [right]");
    }
    // The same limits as for values that are given directly.
    const auto checked = read_values(values_text(result.calibration));
    if (!checked) {
        return bad(file, checked.error().message);
    }
    return result;
}

}  // namespace gazeloop::calibration
