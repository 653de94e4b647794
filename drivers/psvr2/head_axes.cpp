#include "drivers/psvr2/head_axes.h"

#include <cmath>

namespace gazeloop::drivers::psvr2 {
namespace {

constexpr std::size_t kEnoughToDecide = 8;
/// Without the eyes' places, after 2 s at 120 Hz, what is published has to do.
constexpr std::size_t kEnoughWithoutPlaces = 240;
/// Pupils lie 45 to 80 mm apart.
constexpr double kLeastApart_mm = 30.0;
constexpr double kMostApart_mm = 100.0;

}  // namespace

HeadAxes::Signs HeadAxes::seen_in(const GazePacket& packet) {
    Signs seen;
    const auto& [left, right] = packet.eyes;
    if (left.origin_mm && right.origin_mm) {
        const double apart_mm = right.origin_mm->x - left.origin_mm->x;
        if (std::abs(apart_mm) > kLeastApart_mm && std::abs(apart_mm) < kMostApart_mm) {
            seen.x = apart_mm > 0.0 ? 1 : -1;
        }
    }
    int ahead = 0;
    int behind = 0;
    for (const EyeBlock& eye : packet.eyes) {
        ahead += eye.direction && eye.direction->z < 0.0 ? 1 : 0;
        behind += eye.direction && eye.direction->z > 0.0 ? 1 : 0;
    }
    if ((ahead == 0) != (behind == 0)) {
        seen.z = ahead > 0 ? 1 : -1;
    }
    return seen;
}

bool HeadAxes::contradicts(const Signs& seen) const {
    // Eyes that look nowhere, or one ahead and one behind, agree with nothing.
    return seen.z != signs_.z || (seen.x != 0 && seen.x != signs_.x);
}

bool HeadAxes::agrees(const GazePacket& packet) {
    const Signs seen = seen_in(packet);
    if (verdict_ == AxesVerdict::Unchecked || verdict_ == AxesVerdict::Unconfirmed) {
        decide(seen);
    }
    return verdict_ != AxesVerdict::Unchecked && !contradicts(seen);
}

void HeadAxes::decide(const Signs& seen) {
    if (seen.z == 0) {
        return;
    }
    if (seen.x == 0) {
        if (verdict_ == AxesVerdict::Unchecked && ++without_places_ >= kEnoughWithoutPlaces) {
            verdict_ = AxesVerdict::Unconfirmed;
        }
        return;
    }
    in_a_row_ = seen == last_seen_ ? in_a_row_ + 1 : 1;
    last_seen_ = seen;
    if (in_a_row_ >= kEnoughToDecide) {
        signs_ = seen;
        verdict_ = seen == kPublished ? AxesVerdict::AsPublished : AxesVerdict::FromData;
    }
}

}  // namespace gazeloop::drivers::psvr2
