#pragma once

#include <cstdint>
#include <vector>

#include "runtime/openxr/xr_check.h"

namespace gazeloop::openxr {

/// OpenXR's two calls for a list: how many, then which. `call` takes capacity, count and items;
/// `what` is xr_check's.
template <typename T, typename Enumerate>
std::vector<T> enumerate(const T& blank, const char* what, Enumerate&& call) {
    std::uint32_t count = 0;
    xr_check(call(0, &count, nullptr), what);
    std::vector<T> items(count, blank);
    if (count > 0) {
        xr_check(call(count, &count, items.data()), what);
    }
    items.resize(count);
    return items;
}

}  // namespace gazeloop::openxr
