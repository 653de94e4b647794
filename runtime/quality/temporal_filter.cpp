#include "runtime/quality/temporal_filter.h"

#include <cmath>
#include <complex>
#include <numbers>

namespace gazeloop::quality {

TemporalResponse::TemporalResponse(double half_response_hz)
    // (1 + (f / f_c)^2)^-2 = 1/2
    : corner_hz_(half_response_hz / std::sqrt(std::numbers::sqrt2 - 1.0)) {}

double TemporalResponse::sustained(double hz) const {
    const double ratio = hz / corner_hz_;
    return std::pow(1.0 + ratio * ratio, -2.0);
}

double TemporalResponse::transient(double hz) const {
    const std::complex<double> one = 1.0 / std::complex<double>(1.0, hz / corner_hz_);
    return kTransientGain * std::abs(one * one - one * one * one * one);
}

std::array<float, TemporalResponse::kStages> TemporalResponse::held_for(double seconds) const {
    const double a = 2.0 * std::numbers::pi * corner_hz_ * seconds;
    std::array<float, kStages> factors{};
    double factor = std::exp(-a);
    for (std::size_t k = 0; k < kStages; ++k) {
        factors[k] = static_cast<float>(factor);
        factor *= a / static_cast<double>(k + 1);
    }
    return factors;
}

void TemporalFilter::show(const Plane& frame, double seconds, const RowWork& work) {
    if (!any_) {
        stages_.fill(frame);
        any_ = true;
        return;
    }
    const auto factors = response_.held_for(seconds);
    work.over(frame.height, [&](std::uint32_t from, std::uint32_t to) {
        for (std::size_t at = std::size_t{from} * frame.width; at < std::size_t{to} * frame.width;
             ++at) {
            const float shown = frame.values[at];
            std::array<float, TemporalResponse::kStages> away{};
            for (std::size_t k = 0; k < away.size(); ++k) {
                away[k] = stages_[k].values[at] - shown;
            }
            for (std::size_t k = 0; k < away.size(); ++k) {
                float sum = 0.0F;
                for (std::size_t j = 0; j <= k; ++j) {
                    sum += away[j] * factors[k - j];
                }
                stages_[k].values[at] = shown + sum;
            }
        }
    });
}

void TemporalFilter::transient(const RowWork& work, Plane& plane) const {
    const Plane& second = stages_[1];
    const Plane& fourth = stages_[3];
    plane.resize(second.width, second.height);
    constexpr auto kGain = static_cast<float>(TemporalResponse::kTransientGain);
    work.over(plane.height, [&](std::uint32_t from, std::uint32_t to) {
        for (std::size_t at = std::size_t{from} * plane.width; at < std::size_t{to} * plane.width;
             ++at) {
            plane.values[at] = kGain * (second.values[at] - fourth.values[at]);
        }
    });
}

}  // namespace gazeloop::quality
