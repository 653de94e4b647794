#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "runtime/frame/frame_gaze.h"
#include "runtime/frame/frame_record.h"
#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::latency {

/// Finds out of a session's own samples where the eye looked when a frame was shown: those that
/// arrived too late for it tell. The two samples around the middle of the frame's emission are
/// taken in world, each by its own head pose, and the direction between them by time is held
/// against the fovea's, in world by the view that was rendered. So the error is what age, eye and
/// head have left, if the runtime shows the picture where it was rendered for (reprojection), and
/// has no part of the tracker's own error.
///
/// `without_poses_radians` is the same for the direction in the head of the sample that the fovea
/// rests on, taken along with the head of the frame. Where samples have no head pose, the eye's
/// true direction is taken in the head too, and only this error is known.
///
/// In fixed memory (about 130 KB), without allocation after construction.
class GazeErrors {
  public:
    /// A sample is no witness for a time that is further from it than this.
    static constexpr std::int64_t kNear_ns = 25'000'000;

    /// In the order of arrival. One whose time is before that of the sample before is left out.
    void add(const gaze::GazeSample& sample);
    /// From here on poses are in another world.
    void move_origin(const gaze::Pose& new_in_old);
    /// A rendered frame, after the samples that it consumed; in the order of their indices.
    void add(const frame::FrameRecord& record);
    /// The middle of the frame's emission, once it is known what became of it; unknown where that
    /// stays so. To be told within 16 frames, as PendingFrames does.
    void set_shown(std::uint64_t index, const time::Stamp& shown);
    /// No sample follows.
    void finish();

    /// `take(index, error)` is called for each frame that is decided, in the order in which they
    /// were added, with none where the foveae rest on no fresh sample. To be called after each
    /// add() of a frame: one for which no sample comes is given up 64 frames later.
    template <typename Take>
    void take_decided(const Take& take) {
        for (; count_ > 0 && pending_[first_].decided; --count_) {
            const Pending& pending = pending_[first_];
            take(pending.index, pending.of_gaze ? std::optional(pending.error) : std::nullopt);
            first_ = (first_ + 1) % kMost;
        }
    }

  private:
    struct Seen {
        std::uint64_t sequence = 0;
        time::Stamp sampled;
        gaze::PerEye<std::optional<glm::dvec3>> direction_in_head;
        std::optional<glm::dquat> head;
    };
    struct Pending {
        std::uint64_t index = 0;
        bool of_gaze = false;
        bool decided = false;
        frame::GazeError error{};
        time::Stamp shown{};
        glm::dquat head{};                                ///< of the views
        gaze::PerEye<std::optional<glm::dvec3>> fovea{};  ///< in world; none: a damaged file's
        /// In the head, the direction of the sample that the fovea rests on. None: it is not among
        /// the recent ones, or that eye borrows the other one's.
        gaze::PerEye<std::optional<glm::dvec3>> rests_on{};
        std::size_t seen_before = 0;  ///< samples that had come before this frame
    };

    static constexpr std::size_t kMost = 64;      ///< frames that wait for a sample
    static constexpr std::size_t kRecent = 1024;  ///< samples: those of 16 frames and more
    static constexpr std::size_t kLookBack = 32;  ///< samples before a frame that count for it

    /// One of all samples that were kept, if it is among the recent ones.
    [[nodiscard]] const Seen* seen(std::size_t place) const;
    [[nodiscard]] const Seen* find(std::uint64_t sequence, const time::Stamp& sampled) const;
    void decide_by_seen(Pending& pending);
    void compare(Pending& pending, const Seen* before, const Seen& after) const;
    static void decide(Pending& pending, frame::GazeErrorGap gap);

    std::array<Pending, kMost> pending_;
    std::size_t first_ = 0;
    std::size_t count_ = 0;
    time::Stamp sampled_before_;  ///< of the sample that was added last, left out or not
    std::array<Seen, kRecent> recent_;
    std::size_t seen_count_ = 0;  ///< of all that were kept so far
};

}  // namespace gazeloop::latency
