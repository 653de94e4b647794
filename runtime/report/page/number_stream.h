#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gazeloop::report::page {

/// Whole numbers on their way into a page, in little room: each as its difference from the one
/// before. page/numbers.js reads it.
///
/// A number is 1 + zigzag(difference) in groups of 7 bits, least first, with the high bit where a
/// group follows (LEB128); 0 is no number, and leaves the one before as it was.
class NumberStream {
  public:
    /// The next number has none before it: it is its difference from 0.
    void begin_series() { before_ = 0; }
    /// Precondition: |number| <= 2^53, because a script's numbers hold no more.
    void add(std::optional<std::int64_t> number);

    [[nodiscard]] const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
    std::int64_t before_ = 0;
};

/// As a script reads it by DecompressionStream("deflate") and atob(): zlib, then base64.
[[nodiscard]] std::string packed(std::string_view bytes);

}  // namespace gazeloop::report::page
