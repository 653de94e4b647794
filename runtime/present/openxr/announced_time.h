#pragma once

#include <cstdint>
#include <optional>

#include "runtime/frame/event.h"

namespace gazeloop::present {

/// Judges the display times that a runtime announces: they should grow, and lie a few periods
/// ahead. An absurd one says nothing of when its frame is shown:
///
///     none         not positive, or no time of the host's clock
///     far          more than a second from now, either way
///     going back   not after the last good one
///
/// What went back is taken for the new line of time once three in a row have grown and lie ahead of
/// now: then the last good one was absurd itself.
class AnnouncedTime {
  public:
    struct Judgement {
        bool good = false;
        /// Where the frame is likely shown, host time: as announced if good, else as far ahead as
        /// the last good one lay.
        std::int64_t likely_ns = 0;
        std::optional<frame::Event> change;  ///< what is odd now, or is no more
    };

    /// `announced` as the runtime gave it, for the message; `display_ns` the same in host time, as
    /// `now_ns` is, where it has one.
    [[nodiscard]] Judgement next(std::int64_t announced, std::optional<std::int64_t> display_ns,
                                 std::int64_t now_ns);

  private:
    enum class Oddity : std::uint8_t { Good, None, FarAhead, FarBack, WentBack };

    [[nodiscard]] Oddity judge(std::optional<std::int64_t> display_ns, std::int64_t now_ns);
    [[nodiscard]] std::optional<frame::Event> change(Oddity now, std::int64_t announced,
                                                     std::optional<std::int64_t> display_ns,
                                                     std::int64_t now_ns) const;

    std::optional<std::int64_t> good_ns_;    ///< the last good one
    std::optional<std::int64_t> before_ns_;  ///< the last one that is a time, good or not
    std::int64_t lead_ns_ = 0;               ///< of the last good one, to now
    int grown_ahead_ = 0;                    ///< in a row
    Oddity oddity_ = Oddity::Good;           ///< of the last one
    std::uint64_t odd_ = 0;                  ///< in a row
};

/// The display's period as announced; 0, which says that it is not known, for an absurd one.
/// `change` is set where an absurd one follows on none.
class AnnouncedPeriod {
  public:
    struct Judgement {
        std::int64_t period_ns = 0;
        std::optional<frame::Event> change;
    };
    [[nodiscard]] Judgement next(std::int64_t period_ns);

  private:
    bool odd_ = false;
};

}  // namespace gazeloop::present
