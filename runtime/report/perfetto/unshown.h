#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/report/perfetto/subject.h"

namespace gazeloop::report::perfetto {

/// Why something of a session is not in its trace.
enum class WhyUnshown : std::uint8_t {
    Unknown,     ///< a stamp of it is unknown
    Backwards,   ///< it ends before it begins
    OutOfRange,  ///< its time is negative, or none that a machine has
    TooMany,     ///< more overlap than there are tracks for
};
inline constexpr std::array<std::string_view, 4> kWhyUnshownTexts{
    "what is of unknown time", "what ends before it begins",
    "what is before time 0 or after 146 years", "what overlaps with too much"};

/// Counts what is left out, so that it can be said.
class Unshown {
  public:
    void add(Subject subject, WhyUnshown why) {
        ++counts_[static_cast<std::size_t>(why)][static_cast<std::size_t>(subject)];
    }
    [[nodiscard]] std::uint64_t count(Subject subject, WhyUnshown why) const {
        return counts_[static_cast<std::size_t>(why)][static_cast<std::size_t>(subject)];
    }

    /// "what is of unknown time: 3 of runtime, 1 of gpu"; nothing where nothing is left out.
    [[nodiscard]] std::vector<std::string> texts() const;

  private:
    std::array<std::array<std::uint64_t, kSubjects>, kWhyUnshownTexts.size()> counts_{};
};

}  // namespace gazeloop::report::perfetto
