#include "drivers/fixed/fixed_source.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <system_error>

namespace gazeloop::drivers {
namespace {

/// NaN, which is in no range, for text that is not a number.
double parse_number(std::string_view text) {
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    return error == std::errc{} && stop == end ? value : std::nan("");
}

}  // namespace

Expected<FixedGaze> parse_fixed_gaze(std::string_view text) {
    const std::size_t comma = text.find(',');
    if (comma != std::string_view::npos) {
        const FixedGaze fixed{parse_number(text.substr(0, comma)),
                              parse_number(text.substr(comma + 1))};
        if (std::abs(fixed.azimuth_deg) <= 180.0 && std::abs(fixed.elevation_deg) <= 90.0) {
            return fixed;
        }
    }
    return std::unexpected(
        Error{ErrorKind::Usage,
              fmt::format("gaze '{}': give azimuth (-180 to 180) and elevation (-90 to 90) in "
                          "degrees, e.g. -5,2.5",
                          text)});
}

glm::dvec3 FixedGaze::direction() const {
    const double azimuth = glm::radians(azimuth_deg);
    const double elevation = glm::radians(elevation_deg);
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
            -std::cos(azimuth) * std::cos(elevation)};
}

FixedSource::FixedSource(const FixedGaze& fixed_gaze)
    : gaze_(fixed_gaze), direction_(fixed_gaze.direction()) {}

void FixedSource::poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) {
    gaze::GazeSample sample;
    sample.sequence = sequence_++;
    sample.device_ns = now_ns;
    sample.sampled = {now_ns, time::StampKind::Modelled};
    sample.arrived = sample.sampled;
    for (gaze::EyeRay& ray : sample.eyes) {
        ray.direction = direction_;
        ray.valid = true;
    }
    samples.push_back(sample);
}

std::string FixedSource::description() const {
    return fmt::format("fixed gaze (azimuth {} deg, elevation {} deg)", gaze_.azimuth_deg,
                       gaze_.elevation_deg);
}

}  // namespace gazeloop::drivers
