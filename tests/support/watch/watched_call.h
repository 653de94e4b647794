#pragma once

#include <cstddef>
#include <cstdint>

namespace gazeloop::tests {

/// What a thread has done so far, in all or inside calls of Vulkan and OpenXR.
struct Spent {
    std::int64_t cpu_ns = 0;      ///< CLOCK_THREAD_CPUTIME_ID
    std::size_t allocations = 0;  ///< see allocation_counter.h
    std::uint64_t calls = 0;      ///< of Vulkan and OpenXR

    friend Spent operator-(const Spent& a, const Spent& b) {
        return {a.cpu_ns - b.cpu_ns, a.allocations - b.allocations, a.calls - b.calls};
    }
};

/// Of the calling thread, now, without what it spent inside watched calls.
[[nodiscard]] Spent spent_outside_calls();

/// While one is in scope, the thread is inside a call of Vulkan or OpenXR. They nest.
class WatchedCall {
  public:
    WatchedCall();
    WatchedCall(const WatchedCall&) = delete;
    WatchedCall& operator=(const WatchedCall&) = delete;
    ~WatchedCall();
};

/// CPU time that the watching itself costs between two calls: one reading of the clock, which is
/// part of every figure. Measured once.
[[nodiscard]] std::int64_t cpu_ns_of_watching_a_call();

/// CPU time of this thread's own work from mark_gaze() to the next call of Vulkan; nothing if there
/// was none since.
void mark_gaze();
void end_gaze_mark();  ///< called by Vulkan's watched calls
[[nodiscard]] std::int64_t last_gaze_ns();

}  // namespace gazeloop::tests
