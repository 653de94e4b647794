#include "drivers/trace/row_clock.h"

namespace gazeloop::drivers {

std::int64_t RowClock::since_first_ns(CsvTable& table) {
    constexpr std::int64_t kYear_ns = 366LL * 24 * 3600 * 1'000'000'000;
    const std::int64_t reading = table.integer(column_);
    if (!first_) {
        first_ = reading;
    }
    std::int64_t elapsed = 0;
    if (__builtin_sub_overflow(reading, *first_, &elapsed) ||
        __builtin_mul_overflow(elapsed, ns_per_unit_, &elapsed) || elapsed > kYear_ns ||
        elapsed < -kYear_ns) {
        table.refuse(column_, "is more than a year away from the first row");
        return 0;
    }
    return elapsed;
}

}  // namespace gazeloop::drivers
