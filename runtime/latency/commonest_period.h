#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace gazeloop::latency {

/// Which of the periods that a runtime announces, frame by frame, it announces most often, so that
/// a few odd ones decide nothing. Periods within 1 % of each other count as one. Counted in fixed
/// memory by the Space-Saving algorithm (Metwally, Agrawal, El Abbadi 2005): what makes up more
/// than an eighth of all is among the counted.
class CommonestPeriod {
  public:
    /// Precondition: positive.
    void add(std::int64_t period_ns);

    /// As last announced; of two as common, the one that was announced last. None before the first.
    [[nodiscard]] std::optional<std::int64_t> ns() const;

  private:
    struct Counted {
        std::int64_t first_ns = 0;  ///< what the others are held against, so that none drifts off
        std::int64_t last_ns = 0;
        std::uint64_t times = 0;
        std::uint64_t last_place = 0;  ///< of the last one among all announcements
    };

    std::array<Counted, 8> counted_;
    std::uint64_t announced_ = 0;
};

}  // namespace gazeloop::latency
