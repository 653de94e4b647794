#include "drivers/datagram/osc_gaze.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "runtime/gaze/direction.h"

namespace gazeloop::drivers::datagram {
namespace {

using Numbers = std::span<const double>;

/// As Unity turns: pitch down and yaw to the right are positive, degrees.
std::optional<glm::dvec3> from_pitch_yaw(double pitch_deg, double yaw_deg) {
    constexpr double kMost_deg = 90.0;
    if (!(std::abs(pitch_deg) <= kMost_deg && std::abs(yaw_deg) <= kMost_deg)) {
        return std::nullopt;
    }
    const double pitch = glm::radians(pitch_deg);
    const double yaw = glm::radians(yaw_deg);
    return glm::dvec3{std::sin(yaw) * std::cos(pitch), -std::sin(pitch),
                      -std::cos(yaw) * std::cos(pitch)};
}

/// Unity's axes: +Z forward.
std::optional<glm::dvec3> from_unity(Numbers v) { return gaze::unit({v[0], v[1], -v[2]}); }

/// What a sender may have written ends up on terminals: no control characters, and not much of it.
std::string text_of(const OscMessage& message) {
    constexpr std::size_t kLongest = 60;
    std::string address(message.address.substr(0, kLongest));
    std::ranges::replace_if(address, [](char c) { return c < ' ' || c > '~'; }, '?');
    return fmt::format("{} with {} numbers", address, message.count);
}

/// -1 where it is none.
double share(double number) { return number >= 0.0 && number <= 1.0 ? number : -1.0; }

}  // namespace

void OscGaze::set_both(const std::optional<glm::dvec3>& left,
                       const std::optional<glm::dvec3>& right) {
    sample_ = {};
    sample_.sequence = sequence_++;
    for (const auto& [eye, direction] : {std::pair{0U, left}, {1U, right}}) {
        sample_.eyes[eye].valid = direction.has_value();
        sample_.eyes[eye].direction = direction.value_or(gaze::kStraightAhead);
    }
    has_sample_ = true;
}

bool OscGaze::take(const OscMessage& message, std::int64_t arrived_ns) {
    const Numbers n = message.numbers();
    if (message.address == "/tracking/eye/EyesClosedAmount" && n.size() == 1) {
        openness_ = share(1.0 - n[0]);
        openness_ns_ = arrived_ns;
    } else if (message.address == "/tracking/eye/LeftRightPitchYaw" && n.size() == 4) {
        set_both(from_pitch_yaw(n[0], n[1]), from_pitch_yaw(n[2], n[3]));
    } else if (message.address == "/tracking/eye/CenterPitchYaw" && n.size() == 2) {
        set_both(from_pitch_yaw(n[0], n[1]), from_pitch_yaw(n[0], n[1]));
    } else if (message.address == "/tracking/eye/LeftRightVec" && n.size() == 6) {
        set_both(from_unity(n.first(3)), from_unity(n.last(3)));
    } else if (message.address == "/tracking/eye/CenterVec" && n.size() == 3) {
        set_both(from_unity(n), from_unity(n));
    } else if (message.address == "/gazeloop/gaze" && n.size() == 11) {
        set_both(gaze::unit({n[1], n[2], n[3]}), gaze::unit({n[6], n[7], n[8]}));
        // Exact in a double to 2^53.
        if (n[0] >= 0.0 && n[0] < 9e15) {
            sample_.sequence = static_cast<std::uint64_t>(n[0]);
        }
        for (const std::size_t eye : {0U, 1U}) {
            sample_.eyes[eye].openness = share(n[4 + 5 * eye]);
            sample_.eyes[eye].confidence = share(n[5 + 5 * eye]);
        }
    } else {
        return false;
    }
    return true;
}

std::optional<gaze::GazeSample> OscGaze::take(std::span<const std::uint8_t> packet,
                                              std::int64_t arrived_ns) {
    ++counts_.packets;
    has_sample_ = false;
    OscReader reader(packet);
    OscMessage message;
    while (reader.next(message)) {
        if (!take(message, arrived_ns) && counts_.others++ == 0) {
            first_other_ = text_of(message);
        }
    }
    counts_.damaged += reader.damaged() ? 1 : 0;
    if (!has_sample_) {
        return std::nullopt;
    }
    sample_.arrived = {arrived_ns, time::StampKind::Measured};
    sample_.device_ns = arrived_ns;  // the packets have no time of their own
    for (gaze::EyeRay& ray : sample_.eyes) {
        if (ray.openness == -1.0 && arrived_ns - openness_ns_ <= kLidsLast_ns) {
            ray.openness = openness_;
        }
    }
    return sample_;
}

}  // namespace gazeloop::drivers::datagram
