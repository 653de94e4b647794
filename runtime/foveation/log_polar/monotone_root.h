#pragma once

namespace gazeloop::foveation {

/// The x in [low, high] with f(x) = y, for an increasing f with f(low) <= y <= f(high). Takes
/// Newton's steps, and bisects wherever a step would leave the bracket or f has no slope. Both ends
/// of the bracket close in on x, so that it ends within 200 steps for every increasing f.
template <typename Function, typename Derivative>
double monotone_root(const Function& f, const Derivative& derivative, double low, double high,
                     double y) {
    double x = 0.5 * (low + high);
    for (int step = 0; step < 200; ++step) {
        const double excess = f(x) - y;
        if (excess == 0.0) {
            return x;
        }
        (excess > 0.0 ? high : low) = x;
        double next = x - excess / derivative(x);
        if (!(next > low && next < high)) {  // false for NaN as well
            next = 0.5 * (low + high);
        }
        if (next == x || next <= low || next >= high) {
            return next;
        }
        x = next;
    }
    return x;
}

}  // namespace gazeloop::foveation
