// Whether a recorded loop stood still when its tracker came or went.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "runtime/session/session_file.h"

namespace gazeloop::tests {

/// The longest time between two latches around each event of the tracker's that begins so, and
/// that anywhere else. A machine that is busy with something else holds the loop up too, but not at
/// each of these events and nowhere else: the shortest of the former must not be the longest.
inline void expect_no_standstill_at(const session::SessionFile& file, std::string_view begin) {
    constexpr std::int64_t kAround_ns = 300'000'000;
    struct Change {
        std::int64_t at_ns = 0;
        std::int64_t longest_ns = 0;
    };
    std::vector<Change> changes;
    for (const session::RecordedEvent& event : file.events) {
        if (event.kind == "tracker" && event.text.starts_with(begin)) {
            changes.push_back({.at_ns = event.time.ns});
        }
    }
    ASSERT_FALSE(changes.empty());
    ASSERT_GT(file.frames.size(), 100U);
    std::int64_t longest_elsewhere_ns = 3 * file.frames.front().frame.period_ns;
    // The first frames bring the device's memory and shaders up.
    for (std::size_t i = 10; i < file.frames.size(); ++i) {
        const std::int64_t from_ns = file.frames[i - 1].frame.stamps.latch.ns;
        const std::int64_t to_ns = file.frames[i].frame.stamps.latch.ns;
        bool near = false;
        for (Change& change : changes) {
            if (to_ns > change.at_ns - kAround_ns && from_ns < change.at_ns + kAround_ns) {
                change.longest_ns = std::max(change.longest_ns, to_ns - from_ns);
                near = true;
            }
        }
        if (!near) {
            longest_elsewhere_ns = std::max(longest_elsewhere_ns, to_ns - from_ns);
        }
    }
    const Change& least = *std::ranges::min_element(changes, {}, &Change::longest_ns);
    EXPECT_GT(least.longest_ns, 0) << begin << ": no frame around it";
    EXPECT_LE(least.longest_ns, longest_elsewhere_ns) << begin << ": the loop stood still";
}

}  // namespace gazeloop::tests
