#pragma once

#include <ctime>

namespace gazeloop::bench {

/// Processor time of this process, all threads, s. Other programs on the machine do not lengthen
/// it. A software driver's work is in it, a GPU's is not.
inline double process_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace gazeloop::bench
