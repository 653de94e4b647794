#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "runtime/frame/name_list.h"

namespace gazeloop::frame {

/// Most passes that a run can have: the session has as many columns for their times.
inline constexpr std::size_t kMostPasses = 12;

/// The GPU passes of a run, by name, in the order in which they are recorded. A pass is a named,
/// timed stretch of GPU work. At most kMostPasses.
using PassList = NameList;

/// How long each pass of one frame took, by its place in the run's PassList. A pass that did not
/// run has no duration, and all begin without one: unknown is never 0.
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
    static constexpr std::int64_t kDidNotRun = -1;
    std::array<std::int64_t, kMostPasses> ns_{};
};

}  // namespace gazeloop::frame
