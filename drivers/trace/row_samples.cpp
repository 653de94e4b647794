#include "drivers/trace/row_samples.h"

#include <algorithm>
#include <utility>

#include "runtime/memory/long_memory.h"
#include "runtime/time/span.h"

namespace gazeloop::drivers {

RowSamples::RowSamples(std::shared_ptr<const memory::Spool<KeptRow>> rows, Judged judged)
    : rows_(std::move(rows)),
      reader_(*rows_),
      judged_(std::move(judged)),
      size_(judged_.rows.size()) {
    if (!memory::MemoryLimit::in_force()) {
        held_.resize(size_);
        put_together(0, held_);
        judged_ = {};
        rows_.reset();
    }
}

void RowSamples::read(std::size_t first, std::span<gaze::GazeSample> to) const {
    if (rows_ == nullptr) {
        std::copy_n(held_.begin() + static_cast<std::ptrdiff_t>(first), to.size(), to.begin());
    } else {
        put_together(first, to);
    }
    for (gaze::GazeSample& sample : to) {
        change_.apply_to(sample);
    }
}

std::vector<gaze::GazeSample> RowSamples::take() {
    if (rows_ != nullptr) {
        return SampleSource::take();
    }
    for (gaze::GazeSample& sample : held_) {
        change_.apply_to(sample);
    }
    size_ = 0;
    return std::move(held_);
}

void RowSamples::put_together(std::size_t first, std::span<gaze::GazeSample> to) const {
    std::size_t i = first;
    for (gaze::GazeSample& sample : to) {
        sample = {};
        reader_[judged_.rows[i]].write_to(sample);
        const std::int64_t time_ns = judged_.time_ns[i];
        sample.sequence = judged_.numbers[i];
        sample.device_ns = judged_.device_ns[i];
        sample.sampled = {time_ns, time::StampKind::Modelled};
        if (const auto& delay_ns = judged_.delay_ns[i]) {
            sample.arrived = {time::saturated(static_cast<__int128>(time_ns) + *delay_ns),
                              time::StampKind::Modelled};
        }
        if (judged_.step_ns[i] > 0) {
            sample.uncertainty_ns = judged_.step_ns[i];
        }
        ++i;
    }
}

}  // namespace gazeloop::drivers
