#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace gazeloop {

/// Text of at most `Capacity` bytes in place. Longer text is cut where a UTF-8 character begins.
template <std::size_t Capacity>
class FixedText {
    static_assert(Capacity >= 4, "the longest UTF-8 character must fit");

  public:
    FixedText() = default;
    explicit FixedText(std::string_view text) : size_(cut(text)) {
        std::copy_n(text.data(), size_, bytes_.data());
    }

    [[nodiscard]] std::string_view view() const { return {bytes_.data(), size_}; }

  private:
    static std::size_t cut(std::string_view text) {
        if (text.size() <= Capacity) {
            return text.size();
        }
        // A character has at most three continuation bytes; more of them are no UTF-8 anyway.
        for (std::size_t size = Capacity; size + 3 >= Capacity; --size) {
            if ((static_cast<unsigned char>(text[size]) & 0xC0U) != 0x80U) {
                return size;
            }
        }
        return Capacity;
    }

    std::array<char, Capacity> bytes_{};
    std::size_t size_ = 0;
};

}  // namespace gazeloop
