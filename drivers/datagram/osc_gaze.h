#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "drivers/datagram/osc_packet.h"
#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::drivers::datagram {

/// Gaze from OSC packets as eye trackers of the VRChat world send them, and from one message of our
/// own that says more. Pure. README lists the addresses.
class OscGaze {
  public:
    struct Counts {
        std::uint64_t packets = 0;
        std::uint64_t damaged = 0;  ///< no OSC, or numbers that are no directions
        std::uint64_t others = 0;   ///< messages of something else
    };

    /// The sample of a packet that arrived at a time; none where it says nothing of directions. How
    /// far the lids are closed counts for the samples after it too, for kLidsLast_ns.
    [[nodiscard]] std::optional<gaze::GazeSample> take(std::span<const std::uint8_t> packet,
                                                       std::int64_t arrived_ns);

    [[nodiscard]] const Counts& counts() const { return counts_; }
    /// The first message of something else, for people: its address, and how many numbers it has;
    /// empty: none came.
    [[nodiscard]] const std::string& first_other() const { return first_other_; }

    static constexpr std::int64_t kLidsLast_ns = 1'000'000'000;

  private:
    /// Whether the message was understood; it may have made `sample_` a sample.
    bool take(const OscMessage& message, std::int64_t arrived_ns);
    void set_both(const std::optional<glm::dvec3>& left, const std::optional<glm::dvec3>& right);

    Counts counts_;
    std::string first_other_;
    gaze::GazeSample sample_;
    bool has_sample_ = false;
    std::uint64_t sequence_ = 0;
    double openness_ = -1.0;
    std::int64_t openness_ns_ = 0;
};

}  // namespace gazeloop::drivers::datagram
