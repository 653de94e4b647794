// Preloaded into a program: its wall clock steps by an hour, forwards and backwards in turn, at
// every reading, as if somebody set it all the time. With GAZELOOP_SUSPEND_AT=N the machine seems
// to sleep for 90 s before the N-th reading of CLOCK_BOOTTIME: CLOCK_MONOTONIC stands still
// meanwhile.
#include <dlfcn.h>
#include <sys/time.h>
#include <ctime>

#include <atomic>
#include <cstdlib>

namespace {

constexpr time_t kStepS = 3600;
constexpr time_t kSleepS = 90;

time_t step() {
    static std::atomic<unsigned> readings{0};
    return readings.fetch_add(1) % 2 == 0 ? kStepS : -kStepS;
}

time_t slept() {
    static std::atomic<long> readings{0};
    static const char* const at = std::getenv("GAZELOOP_SUSPEND_AT");
    return at != nullptr && readings.fetch_add(1) + 1 >= std::atol(at) ? kSleepS : 0;
}

}  // namespace

extern "C" {

int clock_gettime(clockid_t clock, timespec* now) {
    static const auto real =
        reinterpret_cast<int (*)(clockid_t, timespec*)>(dlsym(RTLD_NEXT, "clock_gettime"));
    const int result = real(clock, now);
    if (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE) {
        now->tv_sec += step();
    } else if (clock == CLOCK_BOOTTIME) {
        now->tv_sec += slept();
    }
    return result;
}

int gettimeofday(timeval* now, void*) noexcept {
    timespec precise{};
    clock_gettime(CLOCK_REALTIME, &precise);
    *now = {precise.tv_sec, precise.tv_nsec / 1000};
    return 0;
}

time_t time(time_t* out) noexcept {
    timespec now{};
    clock_gettime(CLOCK_REALTIME, &now);
    if (out != nullptr) {
        *out = now.tv_sec;
    }
    return now.tv_sec;
}
}
