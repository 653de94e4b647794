#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "runtime/frame/name_list.h"

namespace gazeloop::frame {

/// Most passes that a run can have: the session has as many columns for their times.
inline constexpr std::size_t kMostPasses = 12;

/// The GPU passes of a run, by name, in the order in which they are recorded. A pass is a named,
/// timed stretch of GPU work. At most kMostPasses.
using PassList = NameList;

/// A time of each pass of one frame, by its place in the run's PassList: how long it took, or when
/// it began. A pass that did not run has none, and all begin without one: unknown is never 0.
class PassTimes {
  public:
    PassTimes() { ns_.fill(kDidNotRun); }

    /// Nanoseconds. Precondition: pass < kMostPasses.
    [[nodiscard]] std::optional<std::int64_t> operator[](std::size_t pass) const {
        return ns_[pass] == kDidNotRun ? std::nullopt : std::optional(ns_[pass]);
    }
    /// None: the pass did not run. Precondition: pass < kMostPasses.
    void set(std::size_t pass, std::optional<std::int64_t> ns) {
        ns_[pass] = ns.value_or(kDidNotRun);
    }

    friend bool operator==(const PassTimes&, const PassTimes&) = default;

  private:
    static constexpr std::int64_t kDidNotRun = std::numeric_limits<std::int64_t>::min();
    std::array<std::int64_t, kMostPasses> ns_{};
};

}  // namespace gazeloop::frame
