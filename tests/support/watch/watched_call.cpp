#include "tests/support/watch/watched_call.h"

#include <ctime>

#include "tests/support/allocation_counter.h"

namespace gazeloop::tests {
namespace {

std::int64_t thread_cpu_ns() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

thread_local unsigned depth = 0;
thread_local Spent at_entry;
thread_local Spent inside;
thread_local std::int64_t gaze_mark_ns = 0;
thread_local SinceGaze since{.fovea_ns = 0, .vulkan_ns = 0};

Spent total() { return {thread_cpu_ns(), allocations_of_this_thread(), 0}; }

}  // namespace

Spent spent_outside_calls() {
    const Spent all = total();
    return {all.cpu_ns - inside.cpu_ns, all.allocations - inside.allocations, inside.calls};
}

WatchedCall::WatchedCall() {
    if (depth++ == 0) {
        at_entry = total();
    }
}

WatchedCall::~WatchedCall() {
    if (--depth == 0) {
        const Spent call = total() - at_entry;
        inside.cpu_ns += call.cpu_ns;
        inside.allocations += call.allocations;
        ++inside.calls;
    }
}

std::int64_t cpu_ns_of_watching_a_call() {
    static const std::int64_t cost = [] {
        constexpr int kCalls = 20'000;
        const Spent before = spent_outside_calls();
        for (int i = 0; i < kCalls; ++i) {
            const WatchedCall call;
        }
        return (spent_outside_calls() - before).cpu_ns / kCalls;
    }();
    return cost;
}

void mark_gaze() {
    since = {};
    gaze_mark_ns = spent_outside_calls().cpu_ns;
}

void mark_foveae() {
    if (since.fovea_ns < 0) {
        since.fovea_ns = spent_outside_calls().cpu_ns - gaze_mark_ns;
    }
}

void mark_vulkan() {
    if (since.fovea_ns >= 0 && since.vulkan_ns < 0) {
        since.vulkan_ns = spent_outside_calls().cpu_ns - gaze_mark_ns;
    }
}

SinceGaze since_gaze() { return since; }

}  // namespace gazeloop::tests
