#include "runtime/latency/commonest_period.h"

#include <algorithm>
#include <cmath>

namespace gazeloop::latency {
namespace {

bool same_period(std::int64_t a_ns, std::int64_t b_ns) {
    constexpr double kTolerance = 0.01;
    const double a = static_cast<double>(a_ns);
    return std::abs(a - static_cast<double>(b_ns)) <= kTolerance * a;
}

}  // namespace

void CommonestPeriod::add(std::int64_t period_ns) {
    auto* one = std::ranges::find_if(counted_, [period_ns](const Counted& counted) {
        return counted.times > 0 && same_period(counted.first_ns, period_ns);
    });
    if (one == counted_.end()) {
        one = std::ranges::min_element(counted_, {}, &Counted::times);
        one->first_ns = period_ns;
    }
    one->last_ns = period_ns;
    ++one->times;
    one->last_place = ++announced_;
}

std::optional<std::int64_t> CommonestPeriod::ns() const {
    if (announced_ == 0) {
        return std::nullopt;
    }
    return std::ranges::max_element(counted_,
                                    [](const Counted& a, const Counted& b) {
                                        return a.times != b.times ? a.times < b.times
                                                                  : a.last_place < b.last_place;
                                    })
        ->last_ns;
}

}  // namespace gazeloop::latency
