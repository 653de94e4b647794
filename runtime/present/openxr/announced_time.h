#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace gazeloop::present {

/// Announced display times should grow, and lie a few periods ahead. They are used as they are;
/// this says where they are odd.
class AnnouncedTime {
  public:
    /// The next announced time, in host time as `now_ns` is; what is odd about it, if anything.
    [[nodiscard]] std::optional<std::string> next(std::int64_t display_ns, std::int64_t now_ns);

  private:
    std::optional<std::int64_t> before_ns_;
    bool near_ = true;
};

}  // namespace gazeloop::present
