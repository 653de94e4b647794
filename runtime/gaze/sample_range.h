#pragma once

#include <concepts>
#include <cstddef>
#include <iterator>
#include <memory>
#include <ranges>
#include <span>
#include <vector>

#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::gaze {

/// A recording's samples, which need not be in memory.
class SampleSource {
  public:
    virtual ~SampleSource() = default;
    [[nodiscard]] virtual std::size_t size() const = 0;
    /// Precondition: first + to.size() <= size().
    virtual void read(std::size_t first, std::span<GazeSample> to) const = 0;
    /// All of them, for whoever reads no more from here: what is in memory is not copied.
    [[nodiscard]] virtual std::vector<GazeSample> take() {
        std::vector<GazeSample> all(size());
        read(0, all);
        return all;
    }
};

/// Samples one after the other, as often as they are asked for, in memory or from a SampleSource,
/// of which some hundred at a time are. Either must outlive the range.
class SampleRange {
  public:
    class Iterator;

    SampleRange() = default;
    template <typename Samples>
        requires std::convertible_to<const Samples&, std::span<const GazeSample>>
    SampleRange(const Samples& samples)  // NOLINT(*-explicit-*): as a span
        : in_memory_(std::span<const GazeSample>(samples)), size_(in_memory_.size()) {}
    SampleRange(const SampleSource& source)  // NOLINT(*-explicit-*)
        : source_(&source), size_(source.size()) {}

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool empty() const { return size_ == 0; }
    [[nodiscard]] Iterator begin() const;
    [[nodiscard]] std::default_sentinel_t end() const { return {}; }

    /// Precondition: i < size().
    [[nodiscard]] GazeSample operator[](std::size_t i) const;
    /// [begin, end). Precondition: begin <= end <= size().
    [[nodiscard]] SampleRange part(std::size_t begin, std::size_t end) const;

  private:
    std::span<const GazeSample> in_memory_;
    const SampleSource* source_ = nullptr;
    std::size_t first_ = 0;  ///< of the source
    std::size_t size_ = 0;
};

class SampleRange::Iterator {
  public:
    using iterator_concept = std::input_iterator_tag;
    using value_type = GazeSample;
    using difference_type = std::ptrdiff_t;

    const GazeSample& operator*() const { return *now_; }
    const GazeSample* operator->() const { return now_; }
    Iterator& operator++() {
        if (++now_ == end_) {
            read_on();
        }
        return *this;
    }
    void operator++(int) { ++*this; }
    friend bool operator==(const Iterator& at, std::default_sentinel_t /*end*/) {
        return at.now_ == at.end_;
    }

  private:
    friend SampleRange;
    explicit Iterator(const SampleRange& range);
    /// Where the block is used up: at its end if there is no other.
    void read_on();

    const GazeSample* now_ = nullptr;
    const GazeSample* end_ = nullptr;  ///< of the block
    const SampleSource* source_ = nullptr;
    std::size_t next_ = 0;  ///< of the source, behind the block
    std::size_t left_ = 0;
    std::unique_ptr<std::vector<GazeSample>> block_;
};

inline SampleRange::Iterator SampleRange::begin() const { return Iterator(*this); }

}  // namespace gazeloop::gaze
