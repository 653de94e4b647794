#include "runtime/gaze/filter/one_euro_filter.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "runtime/gaze/direction.h"

namespace gazeloop::gaze {
namespace {

constexpr double kVelocityCutoff_hz = 1.0;  // the authors'

/// The weight of a new sample in a low-pass of this cut-off.
double weight_of_new(double cutoff_hz, double elapsed_s) {
    const double r = 2.0 * std::numbers::pi * cutoff_hz * elapsed_s;
    return r / (r + 1.0);
}

}  // namespace

glm::dvec3 OneEuroFilter::add(std::int64_t time_ns, const glm::dvec3& direction) {
    if (!last_ns_ || time_ns <= *last_ns_) {
        velocity_ = glm::dvec3{0.0};
        filtered_ = direction;
        delay_s_ = 0.0;
    } else {
        const double elapsed_s =
            static_cast<double>(static_cast<__int128>(time_ns) - *last_ns_) * 1e-9;
        const double new_velocity = weight_of_new(kVelocityCutoff_hz, elapsed_s);
        velocity_ += new_velocity * ((direction - raw_) / elapsed_s - velocity_);
        const double cutoff_hz =
            parameters_.least_cutoff_hz +
            parameters_.cutoff_hz_per_deg_per_s * glm::degrees(glm::length(velocity_));
        const double weight = weight_of_new(cutoff_hz, elapsed_s);
        filtered_ = unit(filtered_ + weight * (direction - filtered_)).value_or(direction);
        delay_s_ = (1.0 - weight) * (delay_s_ + elapsed_s);
    }
    last_ns_ = time_ns;
    raw_ = direction;
    return filtered_;
}

void OneEuroFilter::turn(const glm::dquat& rotation) {
    raw_ = rotation * raw_;
    filtered_ = rotation * filtered_;
    velocity_ = rotation * velocity_;
}

}  // namespace gazeloop::gaze
