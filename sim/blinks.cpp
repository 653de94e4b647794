#include "sim/blinks.h"

#include <algorithm>

#include "sim/random.h"
#include "sim/room_for_plans.h"

namespace gazeloop::sim {
namespace {

constexpr double kShortest_s = 0.1;
constexpr double kLongest_s = 0.4;
constexpr double kShortestPause_s = 0.5;
constexpr double kClosingShare = 1.0 / 3.0;

double smooth(double t) { return t * t * (3.0 - 2.0 * t); }

}  // namespace

Blinks::Blinks(const EyeTerms& terms, std::uint64_t seed) : seed_(seed) {
    if (terms.blinks_per_min > 0.0) {
        // At 60 a minute, the most, .25 s are left for it.
        mean_pause_s_ =
            60.0 / terms.blinks_per_min - (kShortest_s + kLongest_s) / 2.0 - kShortestPause_s;
        blinks_.reserve(room_for_plans(terms.blinks_per_min / 60.0));
        blinks_.push_back({});  // over before it began
        add_blink();
    }
}

void Blinks::plan_until(double time_s) {
    while (!blinks_.empty() && time_s >= blinks_.back().begin_s) {
        add_blink();
    }
}

void Blinks::add_blink() {
    const Blink& last = blinks_.back();
    Random random(seed_, Stream::Blinks, blinks_.size());
    const double begin_s =
        last.begin_s + last.duration_s + kShortestPause_s + random.exponential(mean_pause_s_);
    blinks_.push_back({begin_s, random.uniform(kShortest_s, kLongest_s)});
}

double Blinks::openness(double time_s) const {
    if (blinks_.empty()) {
        return 1.0;
    }
    const auto after =
        std::upper_bound(blinks_.begin(), blinks_.end(), time_s,
                         [](double time, const Blink& blink) { return time < blink.begin_s; });
    const Blink& last = *(after - 1);
    if (time_s >= last.begin_s + last.duration_s) {
        return 1.0;
    }
    const double t = (time_s - last.begin_s) / last.duration_s;
    return t < kClosingShare ? 1.0 - smooth(t / kClosingShare)
                             : smooth((t - kClosingShare) / (1.0 - kClosingShare));
}

}  // namespace gazeloop::sim
