#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace gazeloop::drivers::datagram {

/// A message of OSC 1.0: an address and numbers. What it points to is the packet's.
struct OscMessage {
    static constexpr std::size_t kMostArguments = 16;

    std::string_view address;
    std::array<double, kMostArguments> arguments{};  ///< of the types i, h, f, d, T, F
    std::size_t count = 0;

    [[nodiscard]] std::span<const double> numbers() const { return {arguments.data(), count}; }
};

/// Takes a packet of OSC 1.0 apart. Bundles may lie in bundles, kDeepest deep; their time tags are
/// passed over. Messages with arguments that are no numbers, or more than kMostArguments, are told
/// without arguments.
class OscReader {
  public:
    static constexpr int kDeepest = 4;

    explicit OscReader(std::span<const std::uint8_t> packet) : rest_{packet} {}

    /// The next message; false at the end, and at what is damaged.
    bool next(OscMessage& message);
    /// Whether something stood there that is no OSC.
    [[nodiscard]] bool damaged() const { return damaged_; }

  private:
    bool refuse();

    /// What is left of the packet and of the bundles that the next element lies in.
    std::array<std::span<const std::uint8_t>, kDeepest + 1> rest_{};
    int depth_ = 0;
    bool whole_ = true;  ///< the packet itself has not been looked at
    bool damaged_ = false;
};

}  // namespace gazeloop::drivers::datagram
