#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/frame/frame_record.h"
#include "runtime/gaze/fovea_point.h"
#include "runtime/gaze/gaze_sample.h"
#include "runtime/latency/commonest_period.h"
#include "runtime/latency/gaze_age.h"
#include "runtime/latency/happenings.h"
#include "runtime/latency/pending_frames.h"
#include "runtime/latency/sample_counter.h"
#include "runtime/latency/span_series.h"

namespace gazeloop::latency {

/// What the loop's time is made of.
enum class LoopClock : std::uint8_t {
    Wall,     ///< CLOCK_MONOTONIC
    Virtual,  ///< a replay's own time: every duration of the loop is modelled
};

struct SummaryConfig {
    LoopClock clock = LoopClock::Wall;
    std::int64_t period_ns = 0;  ///< the display's nominal period; 0 if unknown
    /// From a pixel's emission to the photon that counts, from the display's profile.
    std::optional<std::int64_t> switching_ns = std::nullopt;
    /// From the first row's emission to the last one's, from the profile; 0: all rows at once.
    std::optional<std::int64_t> rolling_ns = std::nullopt;
    /// For how long a pixel is lit, about the middle of its emission, from the profile.
    std::optional<std::int64_t> persistence_ns = std::nullopt;
    frame::PassList passes{};  ///< of the run
    frame::GridList grids{};   ///< of the run's method
    std::string assumed{};     ///< figures of the profile that are assumed, not published
};

/// Whether the latencies are those of a headset that keeps up.
enum class Verdict : std::uint8_t {
    RealTime,
    NotRealTime,  ///< the median frame interval is above 1.05 periods, or over 5 % missed theirs
    VirtualTime,  ///< nothing was timed
    Unknown,      ///< fewer than two frame intervals, or no display period
};
inline constexpr std::array<std::string_view, 4> kVerdictNames{"real-time", "not-real-time",
                                                               "virtual-time", "unknown"};

struct FrameCounts {
    std::uint64_t total = 0;
    std::uint64_t rendered = 0;         ///< with should_render; all figures below are of these
    std::uint64_t missed = 0;           ///< shown later than announced
    std::uint64_t periods_missed = 0;   ///< by them together, at least
    std::uint64_t in_time_unknown = 0;  ///< no time of the GPU's end, or of the display
    std::uint64_t display_unknown =
        0;  ///< no time of the display: none, or an absurd one, announced
    /// By the state of the worse eye, in the order of gaze::FoveaState.
    std::array<std::uint64_t, gaze::kFoveaStateNames.size()> by_state{};

    /// Frames in which both foveae rest on a fresh sample.
    [[nodiscard]] std::uint64_t with_gaze() const {
        return by_state[static_cast<std::size_t>(gaze::FoveaState::Tracking)] +
               by_state[static_cast<std::size_t>(gaze::FoveaState::OtherEye)];
    }
};

/// Everything that a summary says. Rows of gaze age and of its stages cover the frames in which
/// both eyes' foveae rest on a fresh sample (tracking or other-eye). Each row covers those of them
/// that know its value. Per frame, the stages and the unaccounted rest add up to the gaze age at
/// display exactly. Hence so do the means where the rows have the same count.
struct SummaryReport {
    SummaryConfig config;
    Verdict verdict = Verdict::Unknown;

    DurationRow gaze_age_at_latch;
    DurationRow gaze_age_read_at_begin;  ///< at the latch, had it been read as the frame began
    DurationRow gaze_age_at_display;
    DurationRow gaze_age_uncertainty;  ///< of both ages, either way
    std::array<DurationRow, kStageCount> stages;
    DurationRow unaccounted;
    DurationRow held_gaze_age_at_display;  ///< in held and returning frames: of the held sample
    DurationRow frame_interval;            ///< from wake_up to wake_up of neighbouring frames
    DurationRow loop_time;                 ///< wake_up -> end_frame
    std::array<DurationRow, frame::kMostPasses> passes;  ///< as config.passes names them

    /// How the gaze age at display was obtained: percent of its length by stamp kind, over all
    /// frames that know the age. The unaccounted part counts as unknown. Absent if no frame knows
    /// the age.
    std::optional<std::array<double, time::kStampKindCount>> share_by_kind_percent;
    FrameCounts frames;
    frame::GazeCounts gaze;
    frame::SampleCounts samples;  ///< sums over the rendered frames

    std::vector<Happening> happenings;   ///< in the order of their first event
    std::uint64_t other_happenings = 0;  ///< events that are in none of these, which were too many
    time::Stamp began;                   ///< the first frame woke up

    /// Missed frames among those of which it is known; absent if there are none.
    [[nodiscard]] std::optional<double> missed_percent() const;
    /// How many times fewer samples than full resolution were shaded; absent if none were.
    [[nodiscard]] std::optional<double> samples_saved_factor() const;
};

/// Gathers a report while frames pass, in fixed memory and without allocation after construction.
class LatencySummary {
  public:
    explicit LatencySummary(const SummaryConfig& config);

    /// A period of the display that the runtime announces, once for each frame. The commonest one
    /// counts, not the profile's. If the profile's display cannot have it, the profile's other
    /// times are another display's, and count as unknown for the whole run. Precondition: positive.
    void add_display_period(std::int64_t period_ns) { periods_.add(period_ns); }
    /// The commonest one so far; none before the first.
    [[nodiscard]] std::optional<std::int64_t> display_period_ns() const { return periods_.ns(); }

    /// In the order in which they were told. Routine is left out.
    void add_event(const time::Stamp& time, std::string_view kind, std::string_view text);

    /// In the order of arrival.
    void add(const gaze::GazeSample& sample);
    /// Of all samples so far, where these themselves are not added.
    void set_gaze_counts(const frame::GazeCounts& counts) { gaze_counts_ = counts; }
    /// In the order of their index.
    void add(const frame::FrameRecord& record);
    /// To be added after its frame, and before 16 later frames; one that comes later counts only
    /// for the passes. In virtual time the frame's own, modelled GPU stamps are used, not those of
    /// this record.
    void add(const frame::FrameGpuRecord& record);

    /// Of everything so far; frames still without a GPU part count as they are.
    [[nodiscard]] SummaryReport report() const;

  private:
    struct Neighbour {
        std::uint64_t index;
        time::Stamp wake_up;
    };

    /// What depends on the display's own times.
    struct AtDisplay {
        SpanSeries gaze_age;
        SpanSeries held_gaze_age;
        SpanSeries row;
        SpanSeries switching;
        SpanSeries unaccounted;
        std::array<double, time::kStampKindCount> length_by_kind_ns{};

        void add_tracking(const GazeAge& age);
    };

    void complete(const FinishedFrame& finished);
    void add_tracking(const GazeAge& age);
    [[nodiscard]] std::int64_t period_in_force_ns() const {
        return periods_.ns().value_or(config_.period_ns);
    }
    [[nodiscard]] SummaryReport report_of_complete() const;

    SummaryConfig config_;  ///< as the profile has it
    CommonestPeriod periods_;
    Happenings happenings_;
    std::optional<time::Stamp> began_;
    PendingFrames pending_;
    std::optional<Neighbour> before_;
    SpanSeries gaze_age_at_latch_;
    SpanSeries gaze_age_read_at_begin_;
    SpanSeries gaze_age_uncertainty_;
    std::array<SpanSeries, kStageCount> stages_;  ///< without those of AtDisplay
    // Whose display it is, the commonest period decides in the end.
    AtDisplay of_profile_;
    AtDisplay of_unknown_;
    SpanSeries frame_interval_;
    SpanSeries loop_time_;
    std::array<SpanSeries, frame::kMostPasses> passes_;
    FrameCounts frames_;
    SampleCounter gaze_;
    std::optional<frame::GazeCounts> gaze_counts_;  ///< in place of gaze_
    frame::SampleCounts samples_;
};

}  // namespace gazeloop::latency
