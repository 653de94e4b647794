#pragma once

#include <cstddef>
#include <limits>
#include <new>
#include <vector>

#include "runtime/memory/long_memory.h"

namespace gazeloop::memory {

/// Takes long blocks from long_memory.h. All are alike: any releases what another allocated.
template <typename Value>
class LongAllocator {
  public:
    using value_type = Value;
    static_assert(alignof(Value) <= __STDCPP_DEFAULT_NEW_ALIGNMENT__);

    LongAllocator() = default;
    template <typename Other>
    LongAllocator(const LongAllocator<Other>& /*other*/) {}  // NOLINT(*-explicit-*): as allocators

    [[nodiscard]] Value* allocate(std::size_t count) {
        if (count > std::numeric_limits<std::size_t>::max() / sizeof(Value)) {
            throw std::bad_array_new_length();
        }
        return static_cast<Value*>(memory::allocate(count * sizeof(Value)));
    }
    void deallocate(Value* values, std::size_t count) noexcept {
        memory::release(values, count * sizeof(Value));
    }

    friend bool operator==(const LongAllocator& /*a*/, const LongAllocator& /*b*/) { return true; }
};

/// A vector that grows with the length of a recording: under a MemoryLimit it lies in a scratch
/// file where it is long, and the process's memory does not grow with it.
template <typename Value>
using LongVector = std::vector<Value, LongAllocator<Value>>;

}  // namespace gazeloop::memory
