#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <istream>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gazeloop::drivers {

class GzipMembers;

/// The bytes of a file; where it is gzip by its first two bytes, what it decompresses to. The file
/// may be of any size, and of several gzip members, one after the other.
class ByteStream {
  public:
    /// `in` must outlive the stream.
    explicit ByteStream(std::istream& in);
    ByteStream(const ByteStream&) = delete;
    ByteStream& operator=(const ByteStream&) = delete;
    ByteStream(ByteStream&&) noexcept;
    ByteStream& operator=(ByteStream&&) noexcept;
    ~ByteStream();

    /// Fills the front of `to`, which is not empty: how many bytes, 0 at the end. Errors, in words:
    /// a file that cannot be read; gzip data that are damaged, end early or have something else
    /// after them.
    [[nodiscard]] std::expected<std::size_t, std::string> read(std::span<char> to);

    /// How many bytes read() will still give; none where nobody knows: gzip, pipes.
    [[nodiscard]] std::optional<std::uint64_t> bytes_left();

    [[nodiscard]] bool is_gzip() const { return gzip_ != nullptr; }

  private:
    /// Reads on where raw_ is used up: false at the end.
    [[nodiscard]] std::expected<bool, std::string> refill();
    [[nodiscard]] std::expected<std::size_t, std::string> decompressed(std::span<char> to);

    std::istream* in_;
    std::vector<char> raw_;   ///< as the file has them
    std::span<char> unused_;  ///< of raw_
    bool started_ = false;
    std::unique_ptr<GzipMembers> gzip_;  ///< null: the file is as it is
};

}  // namespace gazeloop::drivers
