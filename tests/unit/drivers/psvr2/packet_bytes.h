#pragma once

#include <array>
#include <cstdint>
#include <cstring>

namespace gazeloop::tests {

/// A gaze packet byte by byte, in the headset's own axes, from the published description of it:
/// written apart from the decoder and from the simulation.
struct PacketBytes {
    std::array<std::uint8_t, 328> bytes{};

    template <typename T>
    PacketBytes& set(std::size_t at, T value) {
        std::memcpy(bytes.data() + at, &value, sizeof(value));
        return *this;
    }
    PacketBytes& set3(std::size_t at, float x, float y, float z) {
        return set(at, x).set(at + 4, y).set(at + 8, z);
    }
};

/// Both eyes open, 31 mm left and right of the middle, looking a little up and to the left; the
/// headset's X points to the left and its Z forward.
inline PacketBytes good_packet(std::int64_t time_us = 5'000'000, std::uint32_t frame = 7) {
    PacketBytes packet;
    packet.set<std::uint8_t>(0, 'G').set<std::uint8_t>(1, 'S');
    packet.set<std::uint16_t>(2, 3).set<std::uint32_t>(4, 328).set<std::uint32_t>(60, 0xCAFE);
    packet.set<std::int64_t>(80, time_us).set<std::uint32_t>(88, frame);
    for (const std::size_t eye : {92U, 164U}) {
        packet.set<std::uint32_t>(eye, 1).set3(eye + 4, eye == 92 ? 31.F : -32.F, 1.5F, -2.F);
        packet.set<std::uint32_t>(eye + 16, 1).set3(eye + 20, 0.28F, 0.F, 0.96F);
        packet.set<std::uint32_t>(eye + 32, 1).set<float>(eye + 36, eye == 92 ? 3.25F : 4.5F);
        packet.set<std::uint32_t>(eye + 40, 1)
            .set<float>(eye + 44, 0.4F)
            .set<float>(eye + 48, 0.6F);
        packet.set<std::uint32_t>(eye + 52, 1)
            .set<float>(eye + 56, 0.1F)
            .set<float>(eye + 60, 0.2F);
        packet.set<std::uint32_t>(eye + 64, 1).set<std::uint32_t>(eye + 68, 0);
    }
    packet.set<std::uint32_t>(236, 1).set3(240, -0.5F, 1.5F, -2.F);
    packet.set<std::uint32_t>(252, 1).set3(256, 0.28F, 0.F, 0.96F);
    packet.set<std::int64_t>(272, time_us + 250).set<std::uint32_t>(280, frame + 100);
    packet.set<std::uint32_t>(284, 2);
    packet.set3(288, 0.F, 0.6F, 0.8F).set3(300, 0.6F, 0.F, 0.8F).set3(312, 0.F, 0.F, 1.F);
    packet.set<float>(324, 750.F);
    return packet;
}

}  // namespace gazeloop::tests
