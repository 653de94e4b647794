#include "tests/support/misses/sharp_region.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <numeric>

#include "runtime/error.h"
#include "runtime/foveation/plans/acuity_plan.h"

namespace gazeloop::tests {
namespace {

constexpr double kStep_deg = 0.25;
constexpr double kMost_deg = 30.0;

bool counts(const ShownGaze& one, Counted counted) {
    return !one.covered && (!one.in_flight || counted == Counted::SeenOrInFlight);
}

/// `widening_deg(one)`: of a frame's eye.
template <typename Widening>
double share_missed_percent(std::span<const ShownGaze> shown, const SharpRegion& sharp,
                            Counted counted, const Widening& widening_deg) {
    std::size_t missed = 0;
    std::size_t all = 0;
    for (const ShownGaze& one : shown) {
        if (counts(one, counted)) {
            ++all;
            missed += one.error_deg > sharp.radius_deg(widening_deg(one)) ? 1U : 0U;
        }
    }
    return all == 0 ? 0.0 : 100.0 * static_cast<double>(missed) / static_cast<double>(all);
}

}  // namespace

SharpRegion::SharpRegion(const gaze::EyeView& view)
    : profile_(value_or_throw(foveation::AcuityProfile::create({}, view))) {
    foveation::LogPolarPlan plan;
    for (double widening_deg = 0.0; widening_deg <= kMost_deg; widening_deg += kStep_deg) {
        foveation::plan_acuity({}, profile_, view, {0.0, 0.0, -1.0}, plan, nullptr, widening_deg);
        samples_.push_back(
            static_cast<double>(plan.texels.counts.shaded + plan.disc.counts.shaded));
        if (samples_.size() == 1) {
            plain_deg_ = 2.0 * glm::degrees(std::asin(plan.in_gaze_frame->disc_half_sine));
        }
    }
}

double SharpRegion::radius_deg(double widening_deg) const {
    return std::max(plain_deg_, profile_.display_limit_deg() + widening_deg);
}

double SharpRegion::samples(double widening_deg) const {
    const double at = std::clamp(widening_deg, 0.0, kMost_deg - kStep_deg) / kStep_deg;
    const auto before = static_cast<std::size_t>(at);
    return std::lerp(samples_[before], samples_[before + 1], at - static_cast<double>(before));
}

double misses_percent(std::span<const ShownGaze> shown, const SharpRegion& sharp, Counted counted) {
    return share_missed_percent(shown, sharp, counted,
                                [](const ShownGaze& one) { return one.widening_deg; });
}

double misses_percent(std::span<const ShownGaze> shown, const SharpRegion& sharp, Counted counted,
                      double widening_deg) {
    return share_missed_percent(shown, sharp, counted,
                                [=](const ShownGaze&) { return widening_deg; });
}

double constant_widening_deg(std::span<const ShownGaze> shown, const SharpRegion& sharp,
                             Counted counted, double percent) {
    double least = 0.0;
    double most = kMost_deg;
    constexpr double kExact_deg = 0.01;
    if (misses_percent(shown, sharp, counted, least) <= percent) {
        return least;
    }
    while (most - least > kExact_deg) {
        const double middle = std::midpoint(least, most);
        (misses_percent(shown, sharp, counted, middle) <= percent ? most : least) = middle;
    }
    return most;
}

double mean_samples(std::span<const ShownGaze> shown, const SharpRegion& sharp) {
    double sum = 0.0;
    for (const ShownGaze& one : shown) {
        sum += sharp.samples(one.widening_deg);
    }
    return sum / static_cast<double>(std::max<std::size_t>(shown.size(), 1));
}

}  // namespace gazeloop::tests
