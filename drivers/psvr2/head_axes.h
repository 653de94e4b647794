#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

#include "drivers/psvr2/gaze_packet.h"

namespace gazeloop::drivers::psvr2 {

/// How the headset's axes were found to lie.
enum class AxesVerdict : std::uint8_t {
    Unchecked,    ///< too few packets yet: no direction can be trusted
    AsPublished,  ///< as below
    Unconfirmed,  ///< as below as far as can be seen: the eyes' places do not come
    FromData,     ///< otherwise, as the eyes' places and the way they look say
};

/// From the headset's axes to the head's (+X right, +Y up, -Z forward).
///
/// **Not tried on hardware.** Three public drivers that were (PSVR2Toolkit for SteamVR, Monado's, a
/// program made from both) negate X and Z of every vector of the packet: +X to the wearer's left,
/// +Y up, +Z forward. Those are the axes of the tracker's maker too, who uses them in his other
/// headsets and glasses.
///
/// So that gaze is never mirrored in silence, every packet is held against anatomy: the left eye is
/// left of the right one, and eyes look forward. Eight packets in a row that agree decide, and what
/// they say counts more than what is published; until then nothing is passed on. A packet that
/// contradicts afterwards is not to be trusted. Which way is up cannot be checked.
class HeadAxes {
  public:
    /// Takes a packet. False where its directions are not to be used: nothing is decided yet, or
    /// it contradicts what was.
    [[nodiscard]] bool agrees(const GazePacket& packet);

    [[nodiscard]] AxesVerdict verdict() const { return verdict_; }

    /// A vector of a packet that agrees, in the head's axes.
    [[nodiscard]] glm::dvec3 to_head(const glm::dvec3& in_packet) const {
        return {signs_.x * in_packet.x, in_packet.y, signs_.z * in_packet.z};
    }

  private:
    /// What a packet says of an axis: +1 as the head's, -1 against it, 0 nothing.
    struct Signs {
        int x = 0;
        int z = 0;

        friend bool operator==(const Signs&, const Signs&) = default;
    };
    static constexpr Signs kPublished{-1, -1};

    [[nodiscard]] static Signs seen_in(const GazePacket& packet);
    [[nodiscard]] bool contradicts(const Signs& seen) const;
    void decide(const Signs& seen);

    AxesVerdict verdict_ = AxesVerdict::Unchecked;
    Signs signs_ = kPublished;
    Signs last_seen_;
    std::size_t in_a_row_ = 0;
    std::size_t without_places_ = 0;
};

}  // namespace gazeloop::drivers::psvr2
