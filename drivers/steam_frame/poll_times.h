#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

namespace gazeloop::drivers::steam_frame {

/// When to look for the next sample of something that must be asked, so that it is found soon after
/// it is there and few looks find nothing. Sleeps until shortly before it is due by the known
/// period, then looks often; when it is long overdue, seldom. Times in nanoseconds of one clock.
class PollTimes {
  public:
    /// A new sample was found at `now`. `period_ns` 0: not known yet. `age_ns`: how old it was
    /// then, by its own time; none: unknown. The next one is due a period after this one would have
    /// come if nothing had held it up: what is late now says nothing of the next one.
    void found(std::int64_t now_ns, std::int64_t period_ns, std::optional<std::int64_t> age_ns) {
        period_ns_ = period_ns;
        found_ns_ = now_ns;
        std::int64_t late_ns = 0;
        if (age_ns) {
            // The least age of lately, which may have grown: by a hundredth of a period each time.
            least_age_ns_ = std::min(least_age_ns_.value_or(*age_ns) + period_ns / 100, *age_ns);
            late_ns = std::min(*age_ns - *least_age_ns_, period_ns);
        }
        const std::int64_t early_ns = std::clamp(period_ns / 8, kShortest_ns, kEarliest_ns);
        next_ns_ = now_ns + std::max(period_ns - late_ns - early_ns, kShortest_ns);
    }

    /// Nothing new was there at `now`.
    void missed(std::int64_t now_ns) {
        const std::int64_t overdue_ns = now_ns - found_ns_;
        const std::int64_t step_ns = overdue_ns > kSilence_ns ? kSilent_ns
                                     : period_ns_ == 0        ? kUnknown_ns
                                                              : kStep_ns;
        next_ns_ = now_ns + step_ns;
    }

    [[nodiscard]] std::int64_t next_ns() const { return next_ns_; }

    /// How far apart looks are while a sample is due: how late it may be found.
    static constexpr std::int64_t kStep_ns = 200'000;

  private:
    static constexpr std::int64_t kShortest_ns = 200'000;
    static constexpr std::int64_t kEarliest_ns = 800'000;
    static constexpr std::int64_t kUnknown_ns = 1'000'000;
    static constexpr std::int64_t kSilence_ns = 100'000'000;
    static constexpr std::int64_t kSilent_ns = 5'000'000;

    std::int64_t period_ns_ = 0;
    std::int64_t found_ns_ = 0;
    std::int64_t next_ns_ = 0;
    std::optional<std::int64_t> least_age_ns_;
};

}  // namespace gazeloop::drivers::steam_frame
