#include "runtime/latency/ordered_values.h"

#include <algorithm>

namespace gazeloop::latency {

OrderedValues::OrderedValues(std::size_t capacity) : values_(capacity) {}

void OrderedValues::replace(std::optional<std::int64_t> gone, std::optional<std::int64_t> come) {
    std::int64_t* const begin = values_.data();
    std::int64_t* const end = begin + size_;
    std::int64_t* const from = gone ? std::lower_bound(begin, end, *gone) : end;
    size_ +=
        static_cast<std::size_t>(come.has_value()) - static_cast<std::size_t>(gone.has_value());
    if (!come) {
        if (gone) {
            std::copy(from + 1, end, from);
        }
        return;
    }
    std::int64_t* const to = std::upper_bound(begin, end, *come);
    if (to <= from) {
        std::copy_backward(to, from, from + 1);
        *to = *come;
    } else {
        std::copy(from + 1, to, from);
        *(to - 1) = *come;
    }
}

std::optional<std::int64_t> OrderedValues::percentile(unsigned percent) const {
    if (size_ * (100 - percent) < 100) {
        return std::nullopt;
    }
    return values_[(size_ * percent + 99) / 100 - 1];
}

}  // namespace gazeloop::latency
