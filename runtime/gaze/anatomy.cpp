#include "runtime/gaze/anatomy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "runtime/gaze/direction.h"

namespace gazeloop::gaze {
namespace {

/// How many samples of a trace are looked at.
constexpr std::size_t kMostOfTrace = 20'000;

/// Where a sorted list has this share of it below.
double at_share(const std::vector<double>& sorted, double share) {
    const double place = share * static_cast<double>(sorted.size() - 1);
    return sorted[static_cast<std::size_t>(std::lround(place))];
}

double correlation_of(const auto& pairs, auto angle) {
    const auto count = static_cast<double>(pairs.size());
    PerEye<double> mean{};
    for (const auto& pair : pairs) {
        for (const std::size_t e : {0U, 1U}) {
            mean[e] += (pair.*angle)[e] / count;
        }
    }
    double together = 0.0;
    PerEye<double> square{};
    for (const auto& pair : pairs) {
        const double left = (pair.*angle)[0] - mean[0];
        const double right = (pair.*angle)[1] - mean[1];
        together += left * right;
        square[0] += left * left;
        square[1] += right * right;
    }
    const double scale = std::sqrt(square[0] * square[1]);
    return scale > 0.0 ? together / scale : 0.0;
}

double share(std::uint64_t part, std::uint64_t whole) {
    return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

std::string behind_text(const Anatomy& anatomy) {
    const std::uint64_t all = anatomy.directions[0] + anatomy.directions[1];
    const std::uint64_t behind = anatomy.behind[0] + anatomy.behind[1];
    for (const Eye eye : kEyes) {
        if (anatomy.behind[index(eye)] == behind && behind < all &&
            anatomy.behind[index(eye)] == anatomy.directions[index(eye)]) {
            return fmt::format("all gaze of the {} eye points behind the head",
                               kEyeNames[index(eye)]);
        }
    }
    return fmt::format("{:.3g} % of the gaze points behind the head (+Z)",
                       100.0 * share(behind, all));
}

std::string unknown_text(const Anatomy& anatomy) {
    if (anatomy.vergence_deg && anatomy.vergence_deg->median < AnatomyCheck::kSquint_deg) {
        return fmt::format("the eyes look {:.1f} deg apart: a squint, or one eye's gaze is off",
                           -anatomy.vergence_deg->median);
    }
    if (anatomy.directions[0] == 0 && anatomy.directions[1] == 0) {
        return "cannot be told: no gaze";
    }
    if (anatomy.shared > 0 && anatomy.pairs < AnatomyCheck::kEnough) {
        return "ahead; left and right cannot be told from one ray for both eyes";
    }
    if (anatomy.directions[0] == 0 || anatomy.directions[1] == 0) {
        return "ahead; left and right cannot be told from one eye";
    }
    return fmt::format("ahead; left and right cannot be told from {} samples with both eyes",
                       anatomy.pairs);
}

}  // namespace

AnatomyCheck::AnatomyCheck(std::size_t most) {
    pairs_.reserve(most);
    apart_m_.reserve(most);
    sorted_.reserve(most);
}

void AnatomyCheck::add(const GazeSample& sample) {
    PerEye<bool> ahead{};
    bool any_behind = false;
    for (const std::size_t e : {0U, 1U}) {
        const EyeRay& ray = sample.eyes[e];
        if (ray.valid && is_finite(ray.direction)) {
            ++facts_.directions[e];
            ahead[e] = !(ray.direction.z > 0.0);
            facts_.behind[e] += ahead[e] ? 0 : 1;
            any_behind = any_behind || !ahead[e];
        }
    }
    const auto& [left, right] = sample.eyes;
    samples_ += left.valid || right.valid ? 1 : 0;
    samples_behind_ += any_behind && !ahead[0] && !ahead[1] ? 1 : 0;
    if (!ahead[0] || !ahead[1]) {
        return;
    }
    if (sample.parallax_rad || left.direction == right.direction) {
        ++facts_.shared;
        return;
    }
    ++facts_.pairs;
    if (pairs_.size() == pairs_.capacity()) {
        return;
    }
    Pair& pair = pairs_.emplace_back();
    for (const std::size_t e : {0U, 1U}) {
        const glm::dvec3& direction = sample.eyes[e].direction;
        pair.right_deg[e] = glm::degrees(std::atan2(direction.x, -direction.z));
        pair.up_deg[e] =
            glm::degrees(std::atan2(direction.y, std::hypot(direction.x, direction.z)));
    }
    constexpr glm::dvec3 kNone{0.0};
    if (left.origin_m != kNone && right.origin_m != kNone && is_finite(left.origin_m) &&
        is_finite(right.origin_m)) {
        apart_m_.push_back(right.origin_m.x - left.origin_m.x);
    }
}

void AnatomyCheck::differences(PerEye<double> Pair::* angle) {
    sorted_.clear();
    for (const Pair& pair : pairs_) {
        sorted_.push_back((pair.*angle)[0] - (pair.*angle)[1]);
    }
    std::ranges::sort(sorted_);
}

bool AnatomyCheck::one_mirrored() {
    constexpr double kLeast_deg = -5.0;
    constexpr double kMost_deg = 25.0;
    return (at_share(sorted_, 0.1) < kLeast_deg || at_share(sorted_, 0.9) > kMost_deg) &&
           correlation_of(pairs_, &Pair::right_deg) < kAgainst;
}

bool AnatomyCheck::one_upended() {
    constexpr double kMost_deg = 10.0;
    differences(&Pair::up_deg);
    return at_share(sorted_, 0.9) - at_share(sorted_, 0.1) > kMost_deg &&
           correlation_of(pairs_, &Pair::up_deg) < kAgainst;
}

AnatomyVerdict AnatomyCheck::verdict() const {
    const Quartiles& vergence = *facts_.vergence_deg;
    const bool diverging = vergence.median < kDiverging_deg && vergence.upper < 0.0;
    const bool meeting = vergence.median > -kDiverging_deg && vergence.lower > 0.0;
    if (facts_.apart_m && *facts_.apart_m < -kApart_m) {
        return meeting ? AnatomyVerdict::PlacesExchanged : AnatomyVerdict::Exchanged;
    }
    if (vergence.median < kSquint_deg) {
        return AnatomyVerdict::Unknown;
    }
    return diverging ? AnatomyVerdict::Diverging : AnatomyVerdict::Agrees;
}

Anatomy AnatomyCheck::judge() {
    facts_.verdict = AnatomyVerdict::Unknown;
    const double behind =
        share(facts_.behind[0] + facts_.behind[1], facts_.directions[0] + facts_.directions[1]);
    const bool enough = pairs_.size() >= kEnough;
    if (enough) {
        if (apart_m_.size() >= kEnough) {
            std::ranges::sort(apart_m_);
            facts_.apart_m = at_share(apart_m_, 0.5);
        }
        differences(&Pair::right_deg);
        facts_.vergence_deg = {at_share(sorted_, 0.25), at_share(sorted_, 0.5),
                               at_share(sorted_, 0.75)};
    }
    if (behind > 0.5 || (samples_behind_ > 0 && 2 * samples_behind_ >= samples_)) {
        facts_.verdict = AnatomyVerdict::Behind;
    } else if (behind > kSomeBehind) {
        facts_.verdict = AnatomyVerdict::PartlyBehind;
    } else if (enough) {
        facts_.verdict = one_mirrored()  ? AnatomyVerdict::OneMirrored
                         : one_upended() ? AnatomyVerdict::OneUpended
                                         : verdict();
    }
    return facts_;
}

Anatomy anatomy_of(const SampleRange& samples) {
    AnatomyCheck check(std::min(samples.size(), kMostOfTrace));
    const std::size_t step = samples.size() / kMostOfTrace + 1;
    std::size_t i = 0;
    for (const GazeSample& sample : samples) {
        if (i++ % step == 0) {
            check.add(sample);
        }
    }
    return check.judge();
}

std::string anatomy_text(const Anatomy& anatomy) {
    const double median_deg = anatomy.vergence_deg ? anatomy.vergence_deg->median : 0.0;
    switch (anatomy.verdict) {
        case AnatomyVerdict::Agrees:
            return anatomy.apart_m && *anatomy.apart_m > AnatomyCheck::kApart_m
                       ? fmt::format(
                             "agree with anatomy (left eye {:.0f} mm left of the right one, "
                             "median vergence {:.1f} deg)",
                             *anatomy.apart_m * 1e3, median_deg)
                       : fmt::format("agree with anatomy (median vergence {:.1f} deg)", median_deg);
        case AnatomyVerdict::Unknown:
            return unknown_text(anatomy);
        case AnatomyVerdict::Behind:
        case AnatomyVerdict::PartlyBehind:
            return behind_text(anatomy);
        case AnatomyVerdict::OneMirrored:
            return "the eyes look left and right against each other: one of them is mirrored";
        case AnatomyVerdict::OneUpended:
            return "the eyes look up and down against each other: one of them is upside down";
        case AnatomyVerdict::Diverging:
            return fmt::format(
                "the eyes' rays diverge (median {:.1f} deg): left and right are "
                "exchanged, or the eyes squint outwards",
                median_deg);
        case AnatomyVerdict::Exchanged:
            return fmt::format(
                "the left eye lies {:.0f} mm right of the right one (median vergence "
                "{:.1f} deg): the eyes are exchanged, or left and right",
                -anatomy.apart_m.value_or(0.0) * 1e3, median_deg);
        case AnatomyVerdict::PlacesExchanged:
            return fmt::format(
                "the left eye lies {:.0f} mm right of the right one though their "
                "rays meet (median {:.1f} deg): the places are mirrored",
                -anatomy.apart_m.value_or(0.0) * 1e3, median_deg);
    }
    return "";
}

}  // namespace gazeloop::gaze
