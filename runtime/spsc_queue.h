#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <utility>
#include <vector>

namespace gazeloop {

/// A bounded queue from one thread to one other, without locks and without allocation after
/// construction. All its memory is touched at construction, so that no push meets a page fault.
template <typename T>
class SpscQueue {
  public:
    /// `capacity` is rounded up to a power of two.
    explicit SpscQueue(std::size_t capacity) : slots_(std::bit_ceil(capacity)) {}

    /// Producer only. False, and nothing done, when the queue is full.
    template <typename U>
    bool try_push(U&& value) {
        const std::size_t tail = tail_.load(std::memory_order_relaxed);
        if (tail - head_seen_ == slots_.size()) {
            head_seen_ = head_.load(std::memory_order_acquire);
            if (tail - head_seen_ == slots_.size()) {
                return false;
            }
        }
        slots_[tail & (slots_.size() - 1)] = std::forward<U>(value);
        tail_.store(tail + 1, std::memory_order_release);
        return true;
    }

    /// Consumer only. The oldest element, null when there is none; it stays until pop().
    [[nodiscard]] const T* front() {
        const std::size_t head = head_.load(std::memory_order_relaxed);
        if (head == tail_seen_) {
            tail_seen_ = tail_.load(std::memory_order_acquire);
            if (head == tail_seen_) {
                return nullptr;
            }
        }
        return &slots_[head & (slots_.size() - 1)];
    }

    /// Consumer only. Precondition: front() was not null.
    void pop() {
        head_.store(head_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
    }

    [[nodiscard]] std::size_t capacity() const { return slots_.size(); }

  private:
    // Each side has a cache line of its own, with its last look at the other side's counter.
    static constexpr std::size_t kCacheLine = 64;

    std::vector<T> slots_;
    alignas(kCacheLine) std::atomic<std::size_t> tail_{0};  ///< written by the producer
    std::size_t head_seen_ = 0;
    alignas(kCacheLine) std::atomic<std::size_t> head_{0};  ///< written by the consumer
    std::size_t tail_seen_ = 0;
};

}  // namespace gazeloop
