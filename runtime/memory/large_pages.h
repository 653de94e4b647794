#pragma once

#include <cstddef>
#include <limits>
#include <new>
#include <vector>

namespace gazeloop::memory {

/// Of the kernel's, on the machines that there are. A guess that is wrong costs nothing but speed.
inline constexpr std::size_t kLargePage = std::size_t{2} << 20U;

/// Advises the kernel to back memory that has not been touched yet with large pages, where it is
/// long enough to hold one. The pages at both ends count too: beside more of its kind, they lie in
/// large pages together. Where the advice is not taken, nothing changes.
void advise_large_pages(const void* begin, std::size_t bytes) noexcept;

/// Room for `count` values in large pages: a fault for each small page of a long array takes longer
/// than filling it.
template <typename Value>
void reserve_in_large_pages(std::vector<Value>& values, std::size_t count) {
    if (count > values.capacity()) {
        values.reserve(count);
        advise_large_pages(values.data(), count * sizeof(Value));
    }
}

/// Lays long arrays on the borders of large pages, so that those have all of them. For arrays of
/// some megabytes each, which would else lie half in small ones.
template <typename Value>
class LargePagesAllocator {
  public:
    using value_type = Value;

    LargePagesAllocator() = default;
    template <typename Other>
    LargePagesAllocator(const LargePagesAllocator<Other>& /*other*/) {}  // NOLINT(*-explicit-*)

    [[nodiscard]] Value* allocate(std::size_t count) {
        if (count > std::numeric_limits<std::size_t>::max() / sizeof(Value)) {
            throw std::bad_array_new_length();
        }
        const std::size_t bytes = count * sizeof(Value);
        if (bytes < kLargePage) {
            return static_cast<Value*>(::operator new(bytes));
        }
        void* const block = ::operator new(bytes, std::align_val_t(kLargePage));
        advise_large_pages(block, bytes);
        return static_cast<Value*>(block);
    }
    void deallocate(Value* values, std::size_t count) noexcept {
        const std::size_t bytes = count * sizeof(Value);
        if (bytes < kLargePage) {
            ::operator delete(values, bytes);
        } else {
            ::operator delete(values, bytes, std::align_val_t(kLargePage));
        }
    }

    friend bool operator==(const LargePagesAllocator& /*a*/, const LargePagesAllocator& /*b*/) {
        return true;
    }
};

template <typename Value>
using LargePagesVector = std::vector<Value, LargePagesAllocator<Value>>;

}  // namespace gazeloop::memory
