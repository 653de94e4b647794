#include "runtime/gaze/new_origins.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/trigonometric.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "runtime/gaze/head_limits.h"
#include "runtime/gaze/origin_change.h"
#include "runtime/gaze/usable_pose.h"
#include "runtime/memory/long_vector.h"
#include "runtime/time/span.h"

namespace gazeloop::gaze {
namespace {

struct Known {
    std::size_t sample;
    std::int64_t time_ns;
    Pose pose;
};

std::int64_t ns_between(const Known& from, const Known& to) {
    return time::saturated(static_cast<__int128>(to.time_ns) - from.time_ns);
}

/// Calls `look` with each usable pose whose time is not before the last one's.
void each_known_head(const SampleRange& samples, const auto& look) {
    std::size_t i = 0;
    std::optional<std::int64_t> last_ns;
    for (const GazeSample& sample : samples) {
        const std::int64_t time_ns = sample.sampled.known() ? sample.sampled.ns : sample.arrived.ns;
        const auto pose = usable_pose(sample.head);
        if (pose && time_ns >= last_ns.value_or(time_ns)) {
            look(Known{i, time_ns, *pose});
            last_ns = time_ns;
        }
        ++i;
    }
}

/// The value below which this share of them lies; 0 for none.
std::int64_t quantile(memory::LongVector<std::int64_t>& values, std::size_t of, std::size_t parts) {
    if (values.empty()) {
        return 0;
    }
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * of / parts);
    std::ranges::nth_element(values, at);
    return *at;
}

std::int64_t least_interval_ns(const SampleRange& samples) {
    constexpr std::int64_t kHeadRests_ns = 50'000'000;
    memory::LongVector<std::int64_t> between_samples;
    memory::LongVector<std::int64_t> between_changes;
    std::optional<Known> before;
    std::optional<Known> changed;
    each_known_head(samples, [&](const Known& head) {
        const std::optional<Known> last = std::exchange(before, head);
        if (!last) {
            return;
        }
        if (const std::int64_t ns = ns_between(*last, head); ns > 0) {
            between_samples.push_back(ns);
        }
        if (head.pose.orientation == last->pose.orientation &&
            head.pose.position_m == last->pose.position_m) {
            return;
        }
        if (changed) {
            const std::int64_t ns = ns_between(*changed, head);
            if (ns > 0 && ns < kHeadRests_ns) {
                between_changes.push_back(ns);
            }
        }
        changed = head;
    });
    return std::max(quantile(between_samples, 1, 2), quantile(between_changes, 1, 4));
}

}  // namespace

std::vector<NewOrigin> new_origins(const SampleRange& samples) {
    const std::int64_t least_ns = least_interval_ns(samples);
    std::vector<NewOrigin> found;
    std::optional<Known> last;
    each_known_head(samples, [&](const Known& head) {
        const std::optional<Known> before = std::exchange(last, head);
        if (!before) {
            return;
        }
        const std::int64_t interval_ns = ns_between(*before, head);
        const auto had_s = static_cast<double>(std::max(interval_ns, least_ns)) * 1e-9;
        if (least_time_s(before->pose, head.pose) > had_s) {
            found.push_back({head.sample, head.time_ns, interval_ns,
                             turned_rad(before->pose, head.pose), moved_m(before->pose, head.pose),
                             new_origin_of_still_head(before->pose, head.pose)});
        }
    });
    return found;
}

void report_new_origins(const SampleRange& samples, TraceReport& report) {
    for (const NewOrigin& origin : new_origins(samples)) {
        report.add(
            {.kind = TraceFindingKind::NewOrigin,
             .rows = 1,
             .text = fmt::format(
                 "at {:.3f} s the head turns by {:.1f} deg and moves by {:.3f} m in {:.1f} ms, as "
                 "no head does: its poses go on from where it was",
                 static_cast<double>(origin.time_ns) * 1e-9, glm::degrees(origin.turned_rad),
                 origin.moved_m, static_cast<double>(origin.interval_ns) * 1e-6)});
    }
}

}  // namespace gazeloop::gaze
