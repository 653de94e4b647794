#include "drivers/trace/clock/clock_chain.h"

#include <algorithm>
#include <limits>

#include "runtime/memory/long_vector.h"

namespace gazeloop::drivers {
namespace {

constexpr std::size_t kReadingsPerOneLeftOut = 8;
constexpr std::size_t kFewestToDoubtTheEnds = 16;

/// Readings that join one another, [first, end).
struct Run {
    std::size_t first = 0;
    std::size_t end = 0;
};

memory::LongVector<Run> runs_of(std::size_t count, const ClockSteps& steps) {
    memory::LongVector<Run> runs{{0, 1}};
    for (std::size_t i = 1; i < count; ++i) {
        if (steps.joins(i - 1, i)) {
            ++runs.back().end;
        } else {
            runs.push_back({i, i + 1});
        }
    }
    return runs;
}

/// The best choice of which this run is the last that is kept.
struct Choice {
    double cost = std::numeric_limits<double>::infinity();
    std::size_t before = 0;  ///< the run kept before it; itself: none
};

}  // namespace

memory::LongVector<bool> readings_in_step(std::size_t count, const ClockSteps& steps) {
    memory::LongVector<bool> kept(count, true);
    if (count < 3) {
        return kept;
    }
    const memory::LongVector<Run> runs = runs_of(count, steps);
    if (runs.size() == 1) {
        return kept;
    }
    const std::size_t burst =
        std::clamp<std::size_t>(count / kReadingsPerOneLeftOut, 1, steps.longest_burst);
    const double price =
        static_cast<double>(kLongestBurst) / static_cast<double>(steps.longest_burst);
    const std::size_t end_burst = count < kFewestToDoubtTheEnds ? 0 : burst;

    const auto may_end = [&](const Run& run, std::size_t left_out) {
        return left_out == 0 || (left_out <= end_burst && run.end - run.first > left_out);
    };
    memory::LongVector<Choice> choices(runs.size());
    for (std::size_t r = 0; r < runs.size(); ++r) {
        Choice& choice = choices[r];
        if (may_end(runs[r], runs[r].first)) {
            choice = {price * static_cast<double>(runs[r].first), r};
        }
        for (std::size_t before = r; before-- > 0;) {
            const std::size_t left_out = runs[r].first - runs[before].end;
            if (left_out > burst) {
                break;
            }
            const double cost = choices[before].cost + price * static_cast<double>(left_out);
            if (cost >= choice.cost) {
                continue;
            }
            const double doubt = steps.doubt(runs[before].end - 1, runs[r].first);
            if (cost + doubt < choice.cost && (left_out == 0 || doubt < kDisagree)) {
                choice = {cost + doubt, before};
            }
        }
    }
    std::size_t last = runs.size() - 1;
    double least = choices[last].cost;
    for (std::size_t r = runs.size(); r-- > 0;) {
        const std::size_t left_out = count - runs[r].end;
        if (left_out > end_burst) {
            break;
        }
        const double cost = choices[r].cost + price * static_cast<double>(left_out);
        if (cost < least && may_end(runs[r], left_out)) {
            least = cost;
            last = r;
        }
    }
    std::size_t kept_from = count;  // everything from here on is decided
    for (std::size_t r = last;; r = choices[r].before) {
        std::fill(kept.begin() + static_cast<std::ptrdiff_t>(runs[r].end),
                  kept.begin() + static_cast<std::ptrdiff_t>(kept_from), false);
        kept_from = runs[r].first;
        if (choices[r].before == r) {
            break;
        }
    }
    std::fill(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(kept_from), false);
    return kept;
}

}  // namespace gazeloop::drivers
