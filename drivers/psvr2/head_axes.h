#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

#include "drivers/psvr2/gaze_packet.h"

namespace gazeloop::drivers::psvr2 {

/// How the headset's axes were found to lie.
enum class AxesVerdict : std::uint8_t {
    Unchecked,      ///< too few packets yet: no direction can be trusted
    AsPublished,    ///< as below
    Unconfirmed,    ///< as below as far as can be seen: the eyes' places do not come
    FromData,       ///< otherwise, as the eyes' places and the way they look say
    Contradictory,  ///< the packets contradict each other: no direction can be trusted
};

/// From the headset's axes to the head's (+X right, +Y up, -Z forward).
///
/// **Not tried on hardware.** Three public drivers were: PSVR2Toolkit for SteamVR, Monado's, and a
/// program made from both. They negate X and Z of every vector of the packet: its axes are +X to
/// the wearer's left, +Y up, +Z forward. The tracker's maker uses the same axes in its other
/// headsets and glasses.
///
/// So that gaze is never mirrored in silence, every packet is held against anatomy: the left eye is
/// left of the right one, and eyes look forward. Two thirds of the packets decide, and what they
/// say counts more than what is published. At first 8 of the last 12 decide. Later 120 of the last
/// 180 do, a second's worth at 120 Hz; they can turn every verdict. If no more than half of the
/// last 180 agree with the verdict, or 180 packets gave none, nothing is trusted until packets
/// decide. A packet that contradicts the verdict is never passed on. Which way is up cannot be
/// checked.
class HeadAxes {
  public:
    /// Takes a packet. False where its directions must not be used: nothing is decided yet, or it
    /// contradicts the verdict.
    [[nodiscard]] bool agrees(const GazePacket& packet);

    [[nodiscard]] AxesVerdict verdict() const { return verdict_; }

    /// A vector of a packet that agrees, in the head's axes.
    [[nodiscard]] glm::dvec3 to_head(const glm::dvec3& in_packet) const {
        return {signs_.x * in_packet.x, in_packet.y, signs_.z * in_packet.z};
    }

  private:
    /// What a packet says of an axis: +1 as the head's, -1 against it, 0 nothing or both.
    struct Signs {
        int x = 0;
        int z = 0;

        friend bool operator==(const Signs&, const Signs&) = default;
    };
    static constexpr Signs kPublished{-1, -1};
    static constexpr std::size_t kWindow = 180;

    [[nodiscard]] static Signs seen_in(const GazePacket& packet);
    [[nodiscard]] static bool contradicts(const Signs& seen, const Signs& signs);
    void remember(const Signs& seen);
    void decide();
    [[nodiscard]] bool decided() const;
    /// Of the last `of` packets that were remembered, how many satisfy.
    template <typename Predicate>
    [[nodiscard]] std::size_t count(std::size_t of, Predicate predicate) const;

    AxesVerdict verdict_ = AxesVerdict::Unchecked;
    Signs signs_ = kPublished;
    std::array<Signs, kWindow> seen_{};  ///< of the last packets with a direction, in a ring
    std::size_t remembered_ = 0;         ///< all that ever were
};

}  // namespace gazeloop::drivers::psvr2
