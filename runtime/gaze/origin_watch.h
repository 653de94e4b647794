#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/gaze/gaze_sample.h"
#include "runtime/gaze/origin_change.h"

namespace gazeloop::gaze {

/// Watches over the world that a live runtime gives poses in. Its origin moves when somebody
/// recentres, or when tracking was lost and begins anew elsewhere; some runtimes say so before, and
/// not all move it when they say. Pure.
///
/// A frame's head that no head could have reached since the frame before (head_limits.h) is in a
/// new world. Where the runtime announced it, it said where the new origin is. Else the head is
/// taken to have stood still between the two frames: what is held in world is then held in the head
/// across the change, and in the new world from there on.
///
/// An announcement is followed at the first frame for its time, as OpenXR has it, unless that frame
/// shows that the origin has not moved. Then, and where a frame before its time shows that it has
/// moved already, it is followed when the heads show it. That can be told only of changes that no
/// head makes in a frame (some 15 degrees or 5 cm): smaller ones are believed.
class OriginWatch {
  public:
    void announce(const AnnouncedOrigin& announced);

    /// The head of the next frame, as the runtime gives it for the frame's display time;
    /// `period_ns` of the display, 0: not known. Returns what became of the world since the frame
    /// before; `frame` of it is unset.
    [[nodiscard]] std::optional<OriginChange> next(std::int64_t display_ns, std::int64_t period_ns,
                                                   const Pose& head);

    /// A sample's head as the runtime gives it now, in the world of the frame that was given last.
    /// For a time before that world's first frame runtimes give poses in the new world or in one
    /// before: it is taken for that in which it is nearer to where the frames' heads were then.
    [[nodiscard]] Pose in_this_world(const Pose& head, std::int64_t time_ns) const;

    /// Announcements that no frame has shown a second after their time, since the last call: they
    /// are given up.
    [[nodiscard]] std::uint64_t take_given_up();

  private:
    struct Seen {
        std::int64_t display_ns = 0;
        Pose head;  ///< in the world of the newest frame
    };
    struct Change {
        std::int64_t display_ns = 0;  ///< of the first frame in the new world
        Pose new_in_old;
    };
    static constexpr std::size_t kFrames = 32;  ///< a quarter of a second at 120 Hz

    [[nodiscard]] const Seen& newest() const { return seen_[(count_ - 1) % kFrames]; }
    [[nodiscard]] const Seen& oldest() const {
        return seen_[count_ < kFrames ? 0 : count_ % kFrames];
    }
    [[nodiscard]] Pose head_at(std::int64_t time_ns) const;
    void carry_all(const Pose& new_in_old);

    std::array<Seen, kFrames> seen_{};
    std::size_t count_ = 0;
    std::vector<Change> changes_;  ///< not older than the oldest frame
    std::vector<AnnouncedOrigin> announced_;
    std::uint64_t given_up_ = 0;
};

}  // namespace gazeloop::gaze
