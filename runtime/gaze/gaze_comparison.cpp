#include "runtime/gaze/gaze_comparison.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>
#include <random>
#include <vector>

#include "runtime/gaze/direction.h"
#include "runtime/memory/long_vector.h"

namespace gazeloop::gaze {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

struct Angles {
    double right_deg = kUnknown;
    double up_deg = kUnknown;

    [[nodiscard]] bool known() const { return !std::isnan(right_deg); }
};

/// A recording on a grid of equal steps; NaN where nobody saw the eyes.
struct Signal {
    memory::LongVector<Angles> at;
};

std::optional<Angles> angles_of(const GazeSample& sample) {
    glm::dvec3 sum{0.0};
    for (const EyeRay& ray : sample.eyes) {
        sum += ray.valid ? ray.direction : glm::dvec3{0.0};
    }
    const std::optional<glm::dvec3> direction = unit(sum);
    if (!direction) {
        return std::nullopt;
    }
    return Angles{glm::degrees(std::atan2(direction->x, -direction->z)),
                  glm::degrees(std::atan2(direction->y, std::hypot(direction->x, direction->z)))};
}

double median_step_ms(const SampleRange& samples) {
    memory::LongVector<std::int64_t> steps_ns;
    time::Stamp before;
    for (const GazeSample& sample : samples) {
        if (sample.sampled.known() && before.known() && sample.sampled.ns > before.ns) {
            steps_ns.push_back(sample.sampled.ns - before.ns);
        }
        before = sample.sampled;
    }
    if (steps_ns.empty()) {
        return 0.0;
    }
    const auto middle = steps_ns.begin() + static_cast<std::ptrdiff_t>(steps_ns.size() / 2);
    std::ranges::nth_element(steps_ns, middle);
    return static_cast<double>(*middle) * 1e-6;
}

Signal on_grid(const SampleRange& samples, double step_ms) {
    Signal signal;
    std::optional<double> first_ms;
    std::optional<double> before_ms;
    Angles before;
    for (const GazeSample& sample : samples) {
        if (!sample.sampled.known()) {
            continue;
        }
        const double absolute_ms = static_cast<double>(sample.sampled.ns) * 1e-6;
        first_ms = first_ms.value_or(absolute_ms);
        const double now_ms = absolute_ms - *first_ms;
        if (now_ms > kComparedMost_s * 1e3 || (before_ms && now_ms <= *before_ms)) {
            continue;
        }
        const std::optional<Angles> angles = angles_of(sample);
        if (!angles) {
            continue;
        }
        // Grid points up to here, between the neighbours where they are near.
        while (static_cast<double>(signal.at.size()) * step_ms <= now_ms) {
            const double point_ms = static_cast<double>(signal.at.size()) * step_ms;
            Angles& point = signal.at.emplace_back();
            if (before_ms && now_ms - *before_ms <= kComparedBridge_ms && point_ms >= *before_ms) {
                const double share = (point_ms - *before_ms) / (now_ms - *before_ms);
                point = {std::lerp(before.right_deg, angles->right_deg, share),
                         std::lerp(before.up_deg, angles->up_deg, share)};
            } else if (point_ms == now_ms) {
                point = *angles;
            }
        }
        before = *angles;
        before_ms = now_ms;
    }
    return signal;
}

/// Changes from grid point to grid point.
Signal velocities(const Signal& signal) {
    Signal changes;
    for (std::size_t i = 1; i < signal.at.size(); ++i) {
        changes.at.push_back({signal.at[i].right_deg - signal.at[i - 1].right_deg,
                              signal.at[i].up_deg - signal.at[i - 1].up_deg});
    }
    return changes;
}

/// Sums over a block at a lag, for a correlation of both axes together.
struct Sums {
    double ab = 0.0;
    double aa = 0.0;
    double bb = 0.0;
    std::size_t count = 0;

    void add(const Angles& a, const Angles& b) {
        ab += a.right_deg * b.right_deg + a.up_deg * b.up_deg;
        aa += a.right_deg * a.right_deg + a.up_deg * a.up_deg;
        bb += b.right_deg * b.right_deg + b.up_deg * b.up_deg;
        ++count;
    }
    void add(const Sums& more) {
        ab += more.ab;
        aa += more.aa;
        bb += more.bb;
        count += more.count;
    }
    [[nodiscard]] double correlation() const {
        const double scale = std::sqrt(aa * bb);
        return scale > 0.0 ? ab / scale : 0.0;
    }
};

/// By block of `one`, then by lag.
using Table = std::vector<std::vector<Sums>>;

Table correlate(const Signal& one, const Signal& other, std::size_t block, std::ptrdiff_t most) {
    Table table;
    for (std::size_t begin = 0; begin < one.at.size(); begin += block) {
        std::vector<Sums>& lags = table.emplace_back(static_cast<std::size_t>(2 * most + 1));
        const std::size_t end = std::min(begin + block, one.at.size());
        for (std::ptrdiff_t lag = -most; lag <= most; ++lag) {
            Sums& sums = lags[static_cast<std::size_t>(lag + most)];
            for (std::size_t i = begin; i < end; ++i) {
                const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(i) + lag;
                if (at >= 0 && at < static_cast<std::ptrdiff_t>(other.at.size()) &&
                    one.at[i].known() && other.at[static_cast<std::size_t>(at)].known()) {
                    sums.add(one.at[i], other.at[static_cast<std::size_t>(at)]);
                }
            }
        }
    }
    return table;
}

/// Where the blocks together correlate most, in steps, between grid points by a parabola; none:
/// nowhere enough.
std::optional<double> best_lag(const std::vector<Sums>& lags, std::ptrdiff_t most,
                               std::size_t fewest) {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < lags.size(); ++i) {
        if (lags[i].count >= fewest && lags[i].aa > 0.0 && lags[i].bb > 0.0 &&
            (!best || lags[i].correlation() > lags[*best].correlation())) {
            best = i;
        }
    }
    if (!best) {
        return std::nullopt;
    }
    double between = 0.0;
    if (*best > 0 && *best + 1 < lags.size()) {
        const double left = lags[*best - 1].correlation();
        const double middle = lags[*best].correlation();
        const double right = lags[*best + 1].correlation();
        const double bend = left - 2.0 * middle + right;
        between = bend < 0.0 ? std::clamp(0.5 * (left - right) / bend, -0.5, 0.5) : 0.0;
    }
    return static_cast<double>(*best) - static_cast<double>(most) + between;
}

std::vector<Sums> all_of(const Table& table, std::span<const std::size_t> blocks) {
    std::vector<Sums> all(table.front().size());
    for (const std::size_t block : blocks) {
        for (std::size_t lag = 0; lag < all.size(); ++lag) {
            all[lag].add(table[block][lag]);
        }
    }
    return all;
}

std::optional<std::array<double, 2>> interval_of(const Table& table, std::ptrdiff_t most,
                                                 std::size_t fewest) {
    constexpr std::size_t kFewestBlocks = 8;
    constexpr std::size_t kResamples = 400;
    if (table.size() < kFewestBlocks) {
        return std::nullopt;
    }
    std::mt19937_64 random(1);
    std::vector<double> lags;
    std::vector<std::size_t> blocks(table.size());
    for (std::size_t i = 0; i < kResamples; ++i) {
        for (std::size_t& block : blocks) {
            block = random() % table.size();
        }
        if (const auto lag = best_lag(all_of(table, blocks), most, fewest)) {
            lags.push_back(*lag);
        }
    }
    if (lags.size() < kResamples) {
        return std::nullopt;
    }
    std::ranges::sort(lags);
    return std::array{lags[kResamples * 25 / 1000], lags[kResamples * 975 / 1000]};
}

/// Of the other's angle on one's, over the pairs at a lag.
AxisAgreement agreement(const Signal& one, const Signal& other, double lag,
                        double Angles::* angle) {
    const auto whole = static_cast<std::ptrdiff_t>(std::floor(lag));
    const double share = lag - static_cast<double>(whole);
    memory::LongVector<std::array<double, 2>> pairs;
    for (std::size_t i = 0; i < one.at.size(); ++i) {
        const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(i) + whole;
        if (!one.at[i].known() || at < 0 ||
            at + 1 >= static_cast<std::ptrdiff_t>(other.at.size())) {
            continue;
        }
        const Angles& before = other.at[static_cast<std::size_t>(at)];
        const Angles& after = other.at[static_cast<std::size_t>(at) + 1];
        if (before.known() && after.known()) {
            pairs.push_back({one.at[i].*angle, std::lerp(before.*angle, after.*angle, share)});
        }
    }
    AxisAgreement result;
    if (pairs.empty()) {
        return result;
    }
    const auto count = static_cast<double>(pairs.size());
    double mean_a = 0.0;
    double mean_b = 0.0;
    for (const auto& [a, b] : pairs) {
        mean_a += a / count;
        mean_b += b / count;
    }
    double aa = 0.0;
    double bb = 0.0;
    double ab = 0.0;
    for (const auto& [a, b] : pairs) {
        aa += (a - mean_a) * (a - mean_a);
        bb += (b - mean_b) * (b - mean_b);
        ab += (a - mean_a) * (b - mean_b);
    }
    result.gain = aa > 0.0 ? ab / aa : 0.0;
    result.offset_deg = mean_b - result.gain * mean_a;
    result.residual_deg = std::sqrt(std::max(0.0, bb - result.gain * ab) / count);
    result.correlation = aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : 0.0;
    return result;
}

}  // namespace

Expected<GazeComparison> compare_gaze(const SampleRange& one, const SampleRange& other) {
    constexpr double kFinest_ms = 2.0;
    constexpr double kCoarsest_ms = 20.0;
    const double one_ms = median_step_ms(one);
    const double other_ms = median_step_ms(other);
    if (one_ms <= 0.0 || other_ms <= 0.0) {
        return std::unexpected(
            Error{ErrorKind::BadInput, "recordings of fewer than two samples cannot be compared"});
    }
    GazeComparison comparison{.step_ms =
                                  std::clamp(std::min(one_ms, other_ms), kFinest_ms, kCoarsest_ms)};
    const double step_ms = comparison.step_ms;
    const auto steps = [&](double seconds) {
        return static_cast<std::size_t>(std::llround(seconds * 1e3 / step_ms));
    };
    const auto most = static_cast<std::ptrdiff_t>(steps(kComparedMostLag_s));
    const std::size_t fewest = steps(kComparedLeast_s);
    const Signal a = on_grid(one, step_ms);
    const Signal b = on_grid(other, step_ms);
    const Table table = correlate(velocities(a), velocities(b), steps(kComparedBlock_s), most);
    std::vector<std::size_t> blocks(table.size());
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        blocks[i] = i;
    }
    const std::vector<Sums> all = table.empty() ? std::vector<Sums>{} : all_of(table, blocks);
    const std::optional<double> lag = best_lag(all, most, fewest);
    if (!lag) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  "the recordings have less than 2 s of moving gaze in common: are they of the "
                  "same eyes at the same time?"});
    }
    const Sums& at_best = all[static_cast<std::size_t>(std::llround(*lag) + most)];
    for (const Sums& sums : all) {
        comparison.correlation_at.push_back(sums.count >= fewest ? sums.correlation() : kUnknown);
    }
    comparison.lag_ms = *lag * step_ms;
    comparison.correlation = at_best.correlation();
    comparison.overlap_s = static_cast<double>(at_best.count) * step_ms * 1e-3;
    if (const auto interval = interval_of(table, most, fewest)) {
        comparison.lag_interval_ms = {(*interval)[0] * step_ms, (*interval)[1] * step_ms};
    }
    comparison.azimuth = agreement(a, b, *lag, &Angles::right_deg);
    comparison.elevation = agreement(a, b, *lag, &Angles::up_deg);
    return comparison;
}

}  // namespace gazeloop::gaze
