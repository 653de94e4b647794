#include "drivers/trace/clock/rows_read.h"

#include <sys/mman.h>

#include <bit>
#include <utility>

namespace gazeloop::drivers {
namespace {

/// Lets the kernel hand out what a vector has reserved in large pages: a fault for each small one
/// takes a quarter of the time in which a file is read. Only advice: where it is not taken, or the
/// vector is small, nothing changes.
template <typename Value>
void in_large_pages(std::vector<Value>& reserved) {
    constexpr std::uintptr_t kLarge = std::uintptr_t{2} << 20U;
    const auto begin = std::bit_cast<std::uintptr_t>(reserved.data());
    const std::uintptr_t end = begin + reserved.capacity() * sizeof(Value);
    const std::uintptr_t first = (begin + kLarge - 1) / kLarge * kLarge;
    const std::uintptr_t last = end / kLarge * kLarge;
    if (first < last) {
        madvise(std::bit_cast<void*>(first), last - first, MADV_HUGEPAGE);
    }
}

}  // namespace

RowsRead::RowsRead(std::span<const TraceRow> rows) {
    reserve(rows.size());
    for (const TraceRow& row : rows) {
        add(row);
    }
}

void RowsRead::reserve(std::size_t rows) {
    clocks_.reserve(rows);
    samples_.reserve(rows);
    in_large_pages(clocks_);
    in_large_pages(samples_);
}

void RowsRead::add(const TraceRow& row) {
    clocks_.push_back(row);
    gaze::GazeSample& sample = samples_.emplace_back();
    sample.eyes = row.eyes;
    sample.parallax_rad = row.parallax_rad;
    sample.head = row.head;
}

std::vector<gaze::GazeSample> RowsRead::take(std::span<const std::size_t> rows) {
    clocks_ = {};
    // Where each place's row comes from; those that are not asked for come last. Then in place,
    // cycle by cycle.
    std::vector<std::size_t> from(rows.begin(), rows.end());
    std::vector<bool> taken(samples_.size(), false);
    for (const std::size_t row : rows) {
        taken[row] = true;
    }
    from.reserve(samples_.size());
    for (std::size_t row = 0; row < taken.size(); ++row) {
        if (!taken[row]) {
            from.push_back(row);
        }
    }
    for (std::size_t first = 0; first < from.size(); ++first) {
        if (from[first] == first) {
            continue;
        }
        const gaze::GazeSample moved = samples_[first];
        std::size_t place = first;
        while (from[place] != first) {
            samples_[place] = samples_[from[place]];
            place = std::exchange(from[place], place);
        }
        samples_[place] = moved;
        from[place] = place;
    }
    samples_.resize(rows.size());
    return std::exchange(samples_, {});
}

}  // namespace gazeloop::drivers
