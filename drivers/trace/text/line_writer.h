#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <ostream>
#include <string>
#include <string_view>

#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::drivers {

/// Puts numbers into the cells of a line, with as many digits as it takes to read them back
/// exactly, and without the locale having a say.
class LineWriter {
  public:
    /// `missing` stands in a cell without a number.
    explicit LineWriter(char separator = ',', std::string_view missing = {})
        : separator_(separator), missing_(missing) {}

    template <typename Number>
    void add(Number value) {
        std::array<char, 32> digits{};  // the longest double has 24
        const auto written = std::to_chars(digits.data(), digits.data() + digits.size(), value);
        line_ += std::string_view(digits.data(), written.ptr);
        line_ += separator_;
    }
    void add_text(std::string_view text) {
        line_ += text;
        line_ += separator_;
    }
    void add_missing() { add_text(missing_); }
    void add_finite(double value) {
        if (std::isfinite(value)) {
            add(value);
        } else {
            add_missing();
        }
    }
    void add_finite(const glm::dvec3& v) {
        add_finite(v.x);
        add_finite(v.y);
        add_finite(v.z);
    }

    /// Of an eye; 0,0,0 where it is unknown.
    void add_place(const glm::dvec3& origin_m) {
        constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
        add_finite(origin_m == glm::dvec3{0.0} ? glm::dvec3{kUnknown} : origin_m);
    }

    /// An openness or confidence, which is below 0 where it is unknown.
    void add_if_known(double value) {
        if (value >= 0.0) {
            add(value);
        } else {
            add_missing();
        }
    }
    /// Azimuth and elevation of an eye in degrees, to the right and up, -Z forward; missing where
    /// the tracker does not vouch for it.
    void add_angles(const gaze::EyeRay& ray) {
        if (!ray.valid) {
            add_missing();
            add_missing();
            return;
        }
        const glm::dvec3& d = ray.direction;
        add(glm::degrees(std::atan2(d.x, -d.z)));
        add(glm::degrees(std::atan2(d.y, std::hypot(d.x, d.z))));
    }

    /// At least one cell was added.
    void end(std::ostream& out) {
        line_.back() = '\n';
        out.write(line_.data(), static_cast<std::streamsize>(line_.size()));
        line_.clear();
    }

  private:
    char separator_;
    std::string_view missing_;
    std::string line_;
};

}  // namespace gazeloop::drivers
