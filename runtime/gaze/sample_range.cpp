#include "runtime/gaze/sample_range.h"

#include <algorithm>

namespace gazeloop::gaze {

GazeSample SampleRange::operator[](std::size_t i) const {
    if (source_ == nullptr) {
        return in_memory_[i];
    }
    GazeSample sample;
    source_->read(first_ + i, {&sample, 1});
    return sample;
}

SampleRange SampleRange::part(std::size_t begin, std::size_t end) const {
    SampleRange part = *this;
    part.size_ = end - begin;
    if (source_ == nullptr) {
        part.in_memory_ = in_memory_.subspan(begin, part.size_);
    } else {
        part.first_ = first_ + begin;
    }
    return part;
}

SampleRange::Iterator::Iterator(const SampleRange& range) {
    if (range.source_ == nullptr) {
        now_ = range.in_memory_.data();
        end_ = now_ + range.in_memory_.size();
        return;
    }
    source_ = range.source_;
    next_ = range.first_;
    left_ = range.size_;
    block_ = std::make_unique<std::vector<GazeSample>>();
    read_on();
}

void SampleRange::Iterator::read_on() {
    constexpr std::size_t kBlock = 128;  // stays in the processor's cache
    if (left_ == 0) {
        return;
    }
    const std::size_t count = std::min(kBlock, left_);
    block_->resize(count);
    source_->read(next_, *block_);
    next_ += count;
    left_ -= count;
    now_ = block_->data();
    end_ = now_ + count;
}

}  // namespace gazeloop::gaze
