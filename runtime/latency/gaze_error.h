#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "runtime/frame/frame_record.h"
#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::latency {

/// How far from where the eye looked a frame's fovea was when the frame was shown.
struct FrameGazeError {
    /// Of the worse eye, in degrees, from 0 to 180; of the kind of the less certain of its times.
    /// Unknown where no head poses were recorded: see without_poses.
    std::optional<double> degrees{};
    /// Had the gaze been held in the head, not in world.
    std::optional<double> without_poses_degrees{};
    time::StampKind kind = time::StampKind::Unknown;
    bool of_gaze = false;  ///< false: the foveae rest on no fresh sample, so there is no error
};

/// Frames with gaze whose error is not known, by the first reason that holds.
struct GazeErrorGaps {
    std::uint64_t no_display_time = 0;  ///< nor, in a damaged file, a pose of the head
    std::uint64_t no_sample_near = 0;   ///< none within 25 ms before, or none after
    std::uint64_t eye_lost = 0;         ///< a blink, or no eye that the tracker vouches for
    std::uint64_t no_head = 0;          ///< only `degrees` is unknown: samples have no head pose

    friend bool operator==(const GazeErrorGaps&, const GazeErrorGaps&) = default;
};

/// Finds out of a session's own samples where the eye looked when a frame was shown: those that
/// arrived too late for it tell. The two samples around the middle of the frame's emission are
/// taken in world, each by its own head pose, and the direction between them by time is held
/// against the fovea's, in world by the view that was rendered. So the error is what age, eye and
/// head have left, if the runtime shows the picture where it was rendered for (reprojection), and
/// has no part of the tracker's own error.
///
/// `without_poses_degrees` is the same for the direction in the head of the sample that the fovea
/// rests on, taken along with the head of the frame. Where samples have no head pose, the eye's
/// true direction is taken in the head too, and only this error is known.
class GazeError {
  public:
    /// A sample is no witness for a time that is further from it than this.
    static constexpr std::int64_t kNear_ns = 25'000'000;

    /// In the order of arrival. One whose time is before that of the sample before is left out.
    void add(const gaze::GazeSample& sample);
    /// From here on poses are in another world.
    void move_origin(const gaze::Pose& new_in_old);
    /// After the samples that it consumed; `shown` is the middle of its emission. `of_gaze`: both
    /// foveae rest on a fresh sample; without, nothing else counts.
    void add(const frame::FrameRecord& record, const time::Stamp& shown, bool of_gaze);
    /// No sample follows.
    void finish();

    /// `take(const FrameGazeError&)` is called for each frame that is decided, in the order in
    /// which they were added. To be called after each add() of a frame: one for which no sample
    /// comes is given up 64 frames later.
    template <typename Take>
    void take_decided(const Take& take) {
        for (; count_ > 0 && pending_[first_].decided; --count_) {
            take(pending_[first_].error);
            first_ = (first_ + 1) % kMost;
        }
    }

    [[nodiscard]] const GazeErrorGaps& gaps() const { return gaps_; }

  private:
    struct Seen {
        std::uint64_t sequence = 0;
        time::Stamp sampled;
        gaze::PerEye<std::optional<glm::dvec3>> direction_in_head;
        std::optional<glm::dquat> head;
    };
    struct Pending {
        bool decided = false;
        FrameGazeError error;
        time::Stamp shown;
        glm::dquat head{};                                ///< of the views
        gaze::PerEye<std::optional<glm::dvec3>> fovea{};  ///< in world; none: a damaged file's
        /// In the head, the direction of the sample that the fovea rests on. None: it is not among
        /// the recent ones, or that eye borrows the other one's.
        gaze::PerEye<std::optional<glm::dvec3>> rests_on{};
    };

    static constexpr std::size_t kMost = 64;    ///< frames that wait for a sample
    static constexpr std::size_t kRecent = 32;  ///< samples

    [[nodiscard]] const Seen* find(std::uint64_t sequence, const time::Stamp& sampled) const;
    [[nodiscard]] const Seen* recent(std::size_t back) const;
    void decide_by_past(Pending& pending);
    void decide(Pending& pending, const Seen* before, const Seen& after);
    void give_up(Pending& pending);

    std::array<Pending, kMost> pending_;
    std::size_t first_ = 0;
    std::size_t count_ = 0;
    time::Stamp sampled_before_;  ///< of the sample that was added last, left out or not
    std::array<Seen, kRecent> recent_;
    std::size_t recent_count_ = 0;  ///< of all that were kept so far
    GazeErrorGaps gaps_;
};

}  // namespace gazeloop::latency
