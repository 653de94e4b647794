#include "drivers/psvr2/gaze_packet.h"

#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/gaze/direction.h"

namespace gazeloop::drivers::psvr2 {
namespace {

// Where what is, in bytes.
constexpr std::size_t kMagic = 0;
constexpr std::size_t kVersion = 2;
constexpr std::size_t kSize = 4;
constexpr std::size_t kCalibrationId = 60;
constexpr std::size_t kTimestamp = 80;
constexpr std::size_t kFrame = 88;
constexpr gaze::PerEye<std::size_t> kEye{92, 164};
constexpr std::size_t kFoveatedTimestamp = 272;
// Within an eye's block; each begins with whether it is valid.
constexpr std::size_t kOrigin = 0;
constexpr std::size_t kDirection = 16;
constexpr std::size_t kPupil = 32;
constexpr std::size_t kBlink = 64;

constexpr double kFarthestOrigin_mm = 200.0;
constexpr double kLargestPupil_mm = 15.0;
/// By how much a unit vector's length may be off: far more than rounding, far less than an error.
constexpr double kUnitTolerance = 0.01;
/// Of a direction along Z, whichever way that is: 84 degrees to the side, where no eye can look.
constexpr double kLeastAhead = 0.1;

class Reader {
  public:
    explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    [[nodiscard]] std::uint16_t u16(std::size_t at) const {
        return static_cast<std::uint16_t>(bytes_[at] | bytes_[at + 1] << 8U);
    }
    [[nodiscard]] std::uint32_t u32(std::size_t at) const {
        return u16(at) | std::uint32_t{u16(at + 2)} << 16U;
    }
    [[nodiscard]] std::int64_t i64(std::size_t at) const {
        return std::bit_cast<std::int64_t>(u32(at) | std::uint64_t{u32(at + 4)} << 32U);
    }
    [[nodiscard]] double f32(std::size_t at) const { return std::bit_cast<float>(u32(at)); }
    [[nodiscard]] glm::dvec3 vector3(std::size_t at) const {
        return {f32(at), f32(at + 4), f32(at + 8)};
    }
    [[nodiscard]] bool flag(std::size_t at) const { return u32(at) == 1; }

    /// How many values were vouched for and refused.
    [[nodiscard]] std::uint32_t refused() const { return refused_; }

    [[nodiscard]] std::optional<glm::dvec3> origin_mm(std::size_t at) {
        if (!flag(at)) {
            return std::nullopt;
        }
        const glm::dvec3 origin = vector3(at + 4);
        return checked(origin, gaze::is_finite(origin) && glm::length(origin) < kFarthestOrigin_mm);
    }
    [[nodiscard]] std::optional<glm::dvec3> direction(std::size_t at) {
        return flag(at) ? checked_unit(vector3(at + 4)) : std::nullopt;
    }
    [[nodiscard]] std::optional<double> pupil_mm(std::size_t at) {
        if (!flag(at)) {
            return std::nullopt;
        }
        const double pupil = f32(at + 4);
        return checked(pupil, pupil > 0.0 && pupil <= kLargestPupil_mm);
    }
    [[nodiscard]] std::optional<bool> blink(std::size_t at) {
        if (!flag(at)) {
            return std::nullopt;
        }
        return checked(flag(at + 4), u32(at + 4) <= 1);
    }

  private:
    template <typename T>
    [[nodiscard]] std::optional<T> checked(const T& value, bool plausible) {
        refused_ += plausible ? 0 : 1;
        return plausible ? std::optional(value) : std::nullopt;
    }
    [[nodiscard]] std::optional<glm::dvec3> checked_unit(const glm::dvec3& v) {
        const auto normalized =
            std::abs(glm::length(v) - 1.0) <= kUnitTolerance ? gaze::unit(v) : std::nullopt;
        return checked(normalized.value_or(v),
                       normalized && std::abs(normalized->z) >= kLeastAhead);
    }

    std::span<const std::uint8_t> bytes_;
    std::uint32_t refused_ = 0;
};

EyeBlock eye_block(Reader& reader, std::size_t at) {
    return {.origin_mm = reader.origin_mm(at + kOrigin),
            .direction = reader.direction(at + kDirection),
            .pupil_mm = reader.pupil_mm(at + kPupil),
            .blink = reader.blink(at + kBlink)};
}

}  // namespace

std::expected<GazePacket, PacketFault> decode_gaze_packet(std::span<const std::uint8_t> bytes) {
    if (bytes.size() >= 2 && bytes[kMagic] == 'G' && bytes[kMagic + 1] == 'C') {
        return std::unexpected(PacketFault::Calibration);
    }
    if (bytes.size() >= 2 && bytes[kMagic] == 'G' && bytes[kMagic + 1] == 'R') {
        return std::unexpected(PacketFault::Raw);
    }
    if (bytes.size() != kPacketBytes) {
        return std::unexpected(PacketFault::Length);
    }
    if (bytes[kMagic] != 'G' || bytes[kMagic + 1] != 'S') {
        return std::unexpected(PacketFault::Magic);
    }
    Reader reader(bytes);
    if (reader.u32(kSize) > kPacketBytes) {
        return std::unexpected(PacketFault::Size);
    }
    GazePacket packet{.version = reader.u16(kVersion),
                      .calibration_id = reader.u32(kCalibrationId),
                      .timestamp_us = reader.i64(kTimestamp),
                      .frame = reader.u32(kFrame),
                      .eyes = {eye_block(reader, kEye[0]), eye_block(reader, kEye[1])},
                      .foveated_timestamp_us = reader.i64(kFoveatedTimestamp),
                      .implausible = 0};
    packet.implausible = reader.refused();
    return packet;
}

}  // namespace gazeloop::drivers::psvr2
