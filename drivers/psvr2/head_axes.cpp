#include "drivers/psvr2/head_axes.h"

#include <algorithm>
#include <cmath>

namespace gazeloop::drivers::psvr2 {
namespace {

constexpr std::size_t kFirstWindow = 12;
constexpr std::size_t kEnoughAtFirst = 8;
constexpr std::size_t kEnough = 120;
/// Pupils lie 45 to 80 mm apart.
constexpr double kLeastApart_mm = 30.0;
constexpr double kMostApart_mm = 100.0;

bool has_direction(const GazePacket& packet) {
    return packet.eyes[0].direction || packet.eyes[1].direction;
}

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

bool HeadAxes::contradicts(const Signs& seen, const Signs& signs) {
    // Eyes that look nowhere, or one ahead and one behind, agree with nothing.
    return seen.z != signs.z || (seen.x != 0 && seen.x != signs.x);
}

bool HeadAxes::decided() const {
    return verdict_ != AxesVerdict::Unchecked && verdict_ != AxesVerdict::Contradictory;
}

bool HeadAxes::agrees(const GazePacket& packet) {
    if (!has_direction(packet)) {
        return false;
    }
    const Signs seen = seen_in(packet);
    remember(seen);
    decide();
    return decided() && !contradicts(seen, signs_);
}

void HeadAxes::remember(const Signs& seen) {
    seen_[remembered_ % kWindow] = seen;
    ++remembered_;
}

template <typename Predicate>
std::size_t HeadAxes::count(std::size_t of, Predicate predicate) const {
    std::size_t satisfied = 0;
    for (std::size_t i = 1; i <= std::min(of, remembered_); ++i) {
        satisfied += predicate(seen_[(remembered_ - i) % kWindow]) ? 1 : 0;
    }
    return satisfied;
}

void HeadAxes::decide() {
    const Signs last = seen_[(remembered_ - 1) % kWindow];
    const auto same = [&](const Signs& seen) { return seen == last; };
    // Only the signs that came last can have become the majority.
    const bool early = verdict_ == AxesVerdict::Unchecked || verdict_ == AxesVerdict::Unconfirmed;
    if (last.x != 0 && last.z != 0 &&
        ((early && count(kFirstWindow, same) >= kEnoughAtFirst) ||
         count(kWindow, same) >= kEnough)) {
        signs_ = last;
        verdict_ = last == kPublished ? AxesVerdict::AsPublished : AxesVerdict::FromData;
        return;
    }
    if (remembered_ < kWindow) {
        return;
    }
    if (!decided() && count(kWindow, [](const Signs& seen) {
                          return seen == Signs{0, kPublished.z};
                      }) >= kEnough) {
        signs_ = kPublished;
        verdict_ = AxesVerdict::Unconfirmed;
    } else if (!decided() || count(kWindow, [&](const Signs& seen) {
                                 return !contradicts(seen, signs_);
                             }) <= kWindow / 2) {
        verdict_ = AxesVerdict::Contradictory;
    }
}

}  // namespace gazeloop::drivers::psvr2
