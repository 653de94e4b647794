#pragma once

#include <cstddef>

namespace gazeloop::tests {

/// Stands for a member of any type, where only the types count.
struct AnyMember {
    template <typename T>
    operator T() const;
};

/// How many members an aggregate of plain members has, so that a list of them can be held against
/// it.
template <typename Group, typename... Known>
consteval std::size_t member_count() {
    if constexpr (requires { Group{Known()..., AnyMember()}; }) {
        return member_count<Group, Known..., AnyMember>();
    } else {
        return sizeof...(Known);
    }
}

}  // namespace gazeloop::tests
