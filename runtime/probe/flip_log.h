#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/probe/flip.h"
#include "runtime/time/span.h"

namespace gazeloop::probe {

/// A loss from its flip to the flip back.
struct Loss {
    Flip lost;
    std::optional<Flip> found{};  ///< none: the run ended before

    /// By the samples' times, where these are known, else by the latches. Unknown until it is over.
    [[nodiscard]] time::Span lasted() const;
};

/// No blink is as long (100 to 400 ms), and every flash of the lamp must be longer.
inline constexpr std::int64_t kLeastLamp_ns = 600'000'000;

/// What the patch did in a run.
class FlipLog {
  public:
    /// More flips than this are counted, but not kept: the loop allocates nothing.
    static constexpr std::size_t kMost = 20'000;

    FlipLog() { flips_.reserve(kMost); }

    /// Flips alternate, beginning with a loss.
    void add(const Flip& flip);
    /// When the frame came to light, once that is known.
    void set_shown(std::uint64_t index, const time::Stamp& gpu_end);

    [[nodiscard]] std::span<const Flip> flips() const { return flips_; }
    [[nodiscard]] std::uint64_t not_kept() const { return not_kept_; }
    [[nodiscard]] std::vector<Loss> losses() const;
    /// Losses that are over and lasted as long as a flash of the lamp.
    [[nodiscard]] std::uint64_t lamp_flashes() const { return lamp_flashes_; }

  private:
    std::vector<Flip> flips_;
    std::uint64_t not_kept_ = 0;
    std::uint64_t lamp_flashes_ = 0;
};

/// For people; lines end in newlines.
[[nodiscard]] std::string flips_text(const FlipLog& log);
/// For programs. Times: host nanoseconds, null where unknown.
[[nodiscard]] nlohmann::ordered_json flips_json(const FlipLog& log);

}  // namespace gazeloop::probe
