#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/error.h"

namespace gazeloop::probe {

inline constexpr std::string_view kMeasurementFormat = "gazeloop-probe";
inline constexpr int kMeasurementVersion = 1;

/// A delay as a measurement's file states it.
struct MeasuredDelay {
    std::uint64_t trials = 0;
    double mean_ms = 0.0;
    std::optional<double> uncertain_ms;  ///< either way, 95 %
    double min_ms = 0.0;
    double max_ms = 0.0;
};

/// Eye-to-photon as `gazeloop probe --video --json` wrote it.
struct Measurement {
    std::string source;                     ///< the file, for people
    std::optional<MeasuredDelay> eye_lost;  ///< eye-to-photon; none: no trial
    std::optional<MeasuredDelay> eye_found;
    bool pulsed =
        false;  ///< the patch's light: timed by the middle of its emission, else its begin
    std::vector<std::string> warnings{};  ///< what the measurement itself says it may be wrong by
};

/// Errors (BadInput): not such a file, of another version, or with figures that cannot be. Names
/// file and field.
[[nodiscard]] Expected<Measurement> read_measurement(const std::filesystem::path& file);
/// The same for its text; `source` stands for the file in messages.
[[nodiscard]] Expected<Measurement> parse_measurement(std::string_view text,
                                                      const std::string& source);

}  // namespace gazeloop::probe
