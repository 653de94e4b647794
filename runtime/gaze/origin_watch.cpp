#include "runtime/gaze/origin_watch.h"

#include <algorithm>
#include <glm/common.hpp>
#include <ranges>
#include <utility>

#include "runtime/gaze/head_limits.h"
#include "runtime/time/span.h"

namespace gazeloop::gaze {
namespace {

constexpr std::size_t kMostAnnounced = 16;
constexpr std::int64_t kPatience_ns = 1'000'000'000;

// Of displays: what stands where a runtime knows no period, or says one that is none.
constexpr std::int64_t kShortestPeriod_ns = 5'000'000;
constexpr std::int64_t kLongestPeriod_ns = 42'000'000;

/// The time that a head had between two frames. Announced times may stand, or step forth and back
/// by any amount: a head for another time may be anywhere that it can reach in between.
double had_s(std::int64_t before_ns, std::int64_t now_ns, std::int64_t period_ns) {
    const __int128 since_ns = static_cast<__int128>(now_ns) - before_ns;
    const std::int64_t apart_ns = time::saturated(since_ns < 0 ? -since_ns : since_ns);
    return 1e-9 * static_cast<double>(std::max(
                      apart_ns, std::clamp(period_ns, kShortestPeriod_ns, kLongestPeriod_ns)));
}

}  // namespace

void OriginWatch::announce(const AnnouncedOrigin& announced) {
    if (announced_.size() == kMostAnnounced) {
        announced_.erase(announced_.begin());
        ++given_up_;
    }
    announced_.push_back(announced);
}

std::optional<OriginChange> OriginWatch::next(std::int64_t display_ns, std::int64_t period_ns,
                                              const Pose& head) {
    if (count_ == 0) {
        // Nothing is held yet that could be in a world before this one.
        std::erase_if(announced_,
                      [&](const AnnouncedOrigin& a) { return a.time_ns <= display_ns; });
        seen_[count_++] = {display_ns, head};
        return std::nullopt;
    }
    const double time_s = had_s(newest().display_ns, display_ns, period_ns);
    const auto reaches = [&](const Pose& before) { return least_time_s(before, head) <= time_s; };

    OriginChange change;
    bool moved = false;
    bool unsaid = false;
    Pose before = newest().head;
    const auto follow = [&](const Pose& new_in_old, bool announced) {
        change.new_in_old = compose(change.new_in_old, new_in_old);
        change.announced = announced;
        before = carried(new_in_old, before);
        moved = true;
    };
    for (auto a = announced_.begin(); a != announced_.end();) {
        const bool due = a->time_ns <= display_ns;
        bool done = false;
        if (!a->new_in_old) {
            done = due;
            unsaid = unsaid || due;
        } else {
            const bool explains = reaches(carried(*a->new_in_old, before));
            const bool stayed = reaches(before);
            if (due ? explains || !stayed : explains && !stayed) {
                follow(*a->new_in_old, true);
                done = true;
            } else if (time::elapsed_ns(a->time_ns, display_ns) > kPatience_ns) {
                ++given_up_;
                done = true;
            }
        }
        a = done ? announced_.erase(a) : a + 1;
    }
    if (unsaid || !reaches(before)) {
        follow(new_origin_of_still_head(before, head), false);
    }

    if (moved) {
        carry_all(change.new_in_old);
        changes_.push_back({display_ns, change.new_in_old});
    }
    seen_[count_++ % kFrames] = {display_ns, head};
    std::erase_if(changes_, [this](const Change& c) {
        return time::elapsed_ns(oldest().display_ns, c.display_ns) < 0;
    });
    return moved ? std::optional(change) : std::nullopt;
}

void OriginWatch::carry_all(const Pose& new_in_old) {
    for (Seen& seen : seen_) {
        seen.head = carried(new_in_old, seen.head);
    }
}

Pose OriginWatch::head_at(std::int64_t time_ns) const {
    const std::size_t first = count_ < kFrames ? 0 : count_ - kFrames;
    const Seen* after = nullptr;
    for (std::size_t i = count_; i-- > first;) {
        const Seen& seen = seen_[i % kFrames];
        if (seen.display_ns <= time_ns) {
            if (after == nullptr || after->display_ns <= seen.display_ns) {
                return seen.head;
            }
            const double fraction =
                static_cast<double>(time::elapsed_ns(seen.display_ns, time_ns)) /
                static_cast<double>(time::elapsed_ns(seen.display_ns, after->display_ns));
            return {glm::normalize(
                        glm::slerp(seen.head.orientation, after->head.orientation, fraction)),
                    glm::mix(seen.head.position_m, after->head.position_m, fraction)};
        }
        after = &seen;
    }
    return oldest().head;
}

Pose OriginWatch::in_this_world(const Pose& head, std::int64_t time_ns) const {
    if (changes_.empty() || time_ns >= changes_.back().display_ns) {
        return head;
    }
    const Pose then = head_at(time_ns);
    Pose nearest = head;
    double least_s = least_time_s(head, then);
    Pose origin;  // of this world, in the one that `head` is tried in
    for (const Change& change : std::views::reverse(changes_)) {
        if (time_ns >= change.display_ns) {
            break;
        }
        origin = compose(change.new_in_old, origin);
        const Pose candidate = carried(origin, head);
        if (const double needed_s = least_time_s(candidate, then); needed_s < least_s) {
            least_s = needed_s;
            nearest = candidate;
        }
    }
    return nearest;
}

std::uint64_t OriginWatch::take_given_up() { return std::exchange(given_up_, 0); }

}  // namespace gazeloop::gaze
