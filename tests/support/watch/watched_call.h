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

/// CPU time of this thread's own work since it looked for gaze. -1: it has not got so far.
struct SinceGaze {
    std::int64_t fovea_ns = -1;   ///< until the foveae were known
    std::int64_t vulkan_ns = -1;  ///< until the first call of Vulkan after that
};
void mark_gaze();
void mark_foveae();  ///< the first one after mark_gaze() counts
void mark_vulkan();  ///< called by Vulkan's watched calls; the first one after mark_foveae() counts
[[nodiscard]] SinceGaze since_gaze();

}  // namespace gazeloop::tests
