#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "runtime/frame/frame_observer.h"
#include "runtime/latency/commonest_period.h"
#include "runtime/latency/frame_account.h"
#include "runtime/latency/gaze_errors.h"
#include "runtime/latency/latency_summary.h"
#include "runtime/report/duration_column.h"
#include "runtime/report/eye_events.h"

namespace gazeloop::report {

/// Every frame of a session with everything that a report says of it: one row for each, in the
/// order of their numbers, and one column for each quantity. Fed by session::play, which tells a
/// frame's GPU part right after the frame; complete after finish(). About 111 bytes a frame.
///
/// Columns cover what the rows of latency::SummaryReport of the same key cover: gaze age and its
/// stages those frames whose foveae both rest on a fresh sample, held_gaze_age_at_display those
/// that hold or return; frame_interval and loop_time all. Per frame, the stages and `unaccounted`
/// add up to gaze_age_at_display exactly.
class FrameLog final : public frame::FrameObserver {
  public:
    explicit FrameLog(const latency::SummaryConfig& config);

    void on_sample(const gaze::GazeSample& sample, std::uint64_t frame) override;
    void on_origin(const gaze::OriginChange& change) override;
    void on_frame(const frame::FrameRecord& record) override;
    void on_gpu(const frame::FrameGpuRecord& record) override;
    void on_gaze(const frame::FrameGaze& gaze) override;
    /// Once, after the last frame. Only then may anything below be asked.
    void finish();
    /// Once, after finish(): what the eyes did when each frame was shown.
    void set_eye_events(const EyeEvents& events);

    /// Of frames: rendered or not.
    [[nodiscard]] std::size_t rows() const { return numbers_.size(); }
    [[nodiscard]] std::uint64_t number(std::size_t row) const;
    /// Host time, nanoseconds; none: unknown.
    [[nodiscard]] std::optional<std::int64_t> wake_up_ns(std::size_t row) const {
        return wake_up_.at(row);
    }
    /// Announced middle of the display's emission, or when the frame was shown, if later.
    [[nodiscard]] std::optional<std::int64_t> shown_ns(std::size_t row) const {
        return shown_.at(row);
    }
    /// Of the worse eye's fovea; none: the frame was not rendered.
    [[nodiscard]] std::optional<gaze::FoveaState> state(std::size_t row) const;
    /// What the eyes did when the frame was shown; none: unknown.
    [[nodiscard]] std::optional<gaze::EyeEvent> eye_event(std::size_t row) const;
    [[nodiscard]] EyeEventSource eye_event_source() const { return eye_event_source_; }

    /// In the order in which a report shows them:
    ///
    ///     gaze_age_at_latch, gaze_age_read_at_begin, gaze_age_at_display, gaze_age_uncertainty,
    ///     stage_tracker ... stage_switching (latency::kStageNames), unaccounted,
    ///     held_gaze_age_at_display, frame_interval, loop_time,
    ///     pass_NAME (by the run's list),                      nanoseconds
    ///     gaze_error_at_display, gaze_error_without_poses,    microdegrees (see
    ///     frame::GazeError) periods_missed, samples_shaded                      counts
    [[nodiscard]] std::span<const DurationColumn> columns() const { return columns_; }
    /// Null: there is none of this key.
    [[nodiscard]] const DurationColumn* column(std::string_view key) const;
    /// Precondition: there is one of this key.
    [[nodiscard]] const DurationColumn& at(std::string_view key) const { return *column(key); }

    /// The rows with the greatest gaze_age_at_display, greatest first, the earlier of two alike
    /// first. Fewer than `count` where fewer know it.
    [[nodiscard]] std::vector<std::size_t> worst(std::size_t count) const;

    /// Of the frames whose gaze error is not known, why.
    /// By frame::GazeErrorGap; without None.
    [[nodiscard]] const std::array<std::uint64_t, frame::kGazeErrorGapCount>& gaze_error_gaps()
        const {
        return gaps_;
    }

  private:
    /// What depends on whether the display is the profile's, which the commonest period decides in
    /// the end.
    struct AtDisplay {
        DurationColumn gaze_age;
        DurationColumn unaccounted;
        DurationColumn held_gaze_age;

        AtDisplay();
        void add(const latency::FrameAccount& account);
        void skip();
    };
    struct Neighbour {
        std::uint64_t index;
        time::Stamp wake_up;
    };

    void complete_last();
    void add_rendered(const latency::FinishedFrame& finished);
    void add_gaze(const latency::FrameAccount& account);
    void skip_rendered();
    void take_errors();
    void skip_errors();
    void add_error(const std::optional<frame::GazeError>& error);
    void gather_columns();

    latency::SummaryConfig config_;  ///< as the profile has it
    latency::CommonestPeriod periods_;
    std::optional<latency::FinishedFrame> last_;  ///< its GPU part may still come
    std::optional<Neighbour> before_;
    latency::GazeErrors gaze_errors_;
    std::optional<frame::FrameGaze> last_gaze_;  ///< of last_, where a session says it
    std::array<std::uint64_t, frame::kGazeErrorGapCount> gaps_{};

    NumberColumn numbers_;  ///< the bits of unsigned ones
    NumberColumn wake_up_;
    NumberColumn shown_;
    std::vector<std::uint8_t> states_;
    std::vector<std::uint8_t> eye_events_;  ///< 0: unknown; empty: of all frames
    EyeEventSource eye_event_source_ = EyeEventSource::None;

    DurationColumn at_latch_;
    DurationColumn read_at_begin_;
    DurationColumn uncertainty_;
    std::vector<DurationColumn> stages_;
    AtDisplay of_profile_;
    AtDisplay of_unknown_;
    DurationColumn frame_interval_;
    DurationColumn loop_time_;
    std::vector<DurationColumn> passes_;
    DurationColumn error_;
    DurationColumn error_without_poses_;
    DurationColumn periods_missed_;
    DurationColumn samples_shaded_;

    std::vector<DurationColumn> columns_;  ///< the above, after finish()
};

}  // namespace gazeloop::report
