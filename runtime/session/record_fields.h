#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "runtime/frame/frame_gaze.h"
#include "runtime/session/record.h"

namespace gazeloop::session {

// Which field of a record lies in which column, in one place for writing and reading. A visitor is
// called as visit(head, tail, field) for the column named head + tail, always in the same order.
// Fields are const when a record is written, and are assigned to when one is read.

// A new member changes its record's size, so that this does not compile any more. Decide whether a
// session keeps it (SCHEMA.md), and let the property test draw it.
static_assert(sizeof(gaze::GazeSample) == 376, "a new member: see above");
static_assert(sizeof(gaze::FoveaPoint) == 192, "a new member: see above");
static_assert(sizeof(gaze::EyeView) == 96, "a new member: see above");
static_assert(sizeof(frame::FrameStamps) == 176, "a new member: see above");
static_assert(sizeof(frame::GridCounts) == 40, "a new member: see above");
static_assert(sizeof(frame::FrameRecord) == 1216, "a new member: see above");
static_assert(sizeof(frame::FrameGpuRecord) == 264, "a new member: see above");
static_assert(sizeof(gaze::OriginChange) == 72, "a new member: see above");

/// By place in the run's lists of grids and passes, which meta keeps.
inline constexpr std::array<std::string_view, 8> kGridColumns{
    "grid_0", "grid_1", "grid_2", "grid_3", "grid_4", "grid_5", "grid_6", "grid_7"};
inline constexpr std::array<std::string_view, 12> kPassColumns{
    "pass_0", "pass_1", "pass_2", "pass_3", "pass_4",  "pass_5",
    "pass_6", "pass_7", "pass_8", "pass_9", "pass_10", "pass_11"};

template <typename Visitor, typename Stamp>
void visit_stamp(Visitor& visit, std::string_view column, Stamp& stamp) {
    visit(column, "_ns", stamp.ns);
    visit(column, "_kind", stamp.kind);
}

template <typename Visitor, typename Pose>
void visit_pose(Visitor& visit, std::string_view column, Pose& pose) {
    visit(column, "_qw", pose.orientation.w);
    visit(column, "_qx", pose.orientation.x);
    visit(column, "_qy", pose.orientation.y);
    visit(column, "_qz", pose.orientation.z);
    visit(column, "_x_m", pose.position_m.x);
    visit(column, "_y_m", pose.position_m.y);
    visit(column, "_z_m", pose.position_m.z);
}

/// What is written if there is no pose: not-a-number becomes NULL.
inline gaze::Pose no_pose() {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    return {glm::dquat{kNan, kNan, kNan, kNan}, glm::dvec3{kNan}};
}

/// What a fitted clock knows of a sample. The columns are NULL where no clock was fitted, and
/// missing in files from before clocks were fitted. `ready` is kept only as measured.
template <typename Visitor, typename Timed>
void visit_clocked(Visitor& visit, Timed& timed) {
    auto ready_ns = timed.ready.known() ? std::optional(timed.ready.ns) : std::nullopt;
    visit("ready", "_ns", ready_ns);
    visit("uncertainty", "_ns", timed.uncertainty_ns);
    if constexpr (!std::is_const_v<Timed>) {
        timed.ready = ready_ns ? time::Stamp{*ready_ns, time::StampKind::Measured} : time::Stamp{};
    }
}

/// A covariance that is not stated is not-a-number thrice, which becomes NULL.
template <typename Visitor, typename Covariance>
void visit_covariance(Visitor& visit, std::string_view eye, Covariance& covariance) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    gaze::DirectionCovariance stored =
        covariance.value_or(gaze::DirectionCovariance{kNan, kNan, kNan});
    visit(eye, "_cov_xx_rad2", stored.xx_rad2);
    visit(eye, "_cov_xy_rad2", stored.xy_rad2);
    visit(eye, "_cov_yy_rad2", stored.yy_rad2);
    if constexpr (!std::is_const_v<Covariance>) {
        const bool stated = !std::isnan(stored.xx_rad2) && !std::isnan(stored.xy_rad2) &&
                            !std::isnan(stored.yy_rad2);
        covariance = stated ? std::optional(stored) : std::nullopt;
    }
}

/// A value whose first name means that nothing is known: that is NULL.
template <typename Visitor, typename Named>
void visit_named(Visitor& visit, std::string_view column, Named& named) {
    using Value = std::remove_const_t<Named>;
    auto stored = named != Value{} ? std::optional<Value>(named) : std::nullopt;
    visit(column, "", stored);
    if constexpr (!std::is_const_v<Named>) {
        named = stored.value_or(Value{});
    }
}

template <typename Visitor, typename Frame, typename Sample>
void visit_sample(Visitor& visit, Frame& frame, Sample& sample) {
    visit("frame", "", frame);
    visit("sequence", "", sample.sequence);
    visit("device", "_ns", sample.device_ns);
    visit_stamp(visit, "sampled", sample.sampled);
    visit_stamp(visit, "arrived", sample.arrived);
    for (const gaze::Eye eye : gaze::kEyes) {
        const std::string_view name = gaze::kEyeNames[gaze::index(eye)];
        auto& ray = sample.eyes[gaze::index(eye)];
        visit(name, "_origin_x_m", ray.origin_m.x);
        visit(name, "_origin_y_m", ray.origin_m.y);
        visit(name, "_origin_z_m", ray.origin_m.z);
        visit(name, "_direction_x", ray.direction.x);
        visit(name, "_direction_y", ray.direction.y);
        visit(name, "_direction_z", ray.direction.z);
        visit(name, "_openness", ray.openness);
        visit(name, "_confidence", ray.confidence);
        visit(name, "_valid", ray.valid);
    }
    bool has_head = sample.head.has_value();
    gaze::Pose head = sample.head.value_or(no_pose());
    visit("has_head", "", has_head);
    visit_pose(visit, "head", head);
    if constexpr (!std::is_const_v<Sample>) {
        sample.head = has_head ? std::optional(head) : std::nullopt;
    }
    visit_clocked(visit, sample);
    visit("parallax", "_rad", sample.parallax_rad);  // missing in older files
    for (const gaze::Eye eye : gaze::kEyes) {
        visit_covariance(visit, gaze::kEyeNames[gaze::index(eye)],
                         sample.eyes[gaze::index(eye)].covariance);
    }
    visit_named(visit, "processing", sample.processing);
    auto gone = sample.tracker_gone ? std::optional(true) : std::nullopt;
    visit("tracker_gone", "", gone);
    if constexpr (!std::is_const_v<Sample>) {
        sample.tracker_gone = gone.value_or(false);
    }
}

/// A count. Where there is none it is 0, and NULL in the file.
template <typename Visitor, typename Count>
void visit_count(Visitor& visit, std::string_view head, std::string_view tail, bool there,
                 Count& count) {
    std::optional<std::uint64_t> stored = there ? std::optional(count) : std::nullopt;
    visit(head, tail, stored);
    if constexpr (!std::is_const_v<Count>) {
        count = stored.value_or(0);
    }
}

/// Columns of grids that the run's method does not have are NULL.
template <typename Visitor, typename Samples>
void visit_samples(Visitor& visit, Samples& samples) {
    static_assert(kGridColumns.size() == frame::kMostGrids);
    for (std::size_t grid = 0; grid < frame::kMostGrids; ++grid) {
        auto& counts = samples.grids[grid];
        const std::string_view name = kGridColumns[grid];
        const bool there = grid < samples.grid_count;
        std::optional<std::uint64_t> planned = there ? std::optional(counts.planned) : std::nullopt;
        visit(name, "_planned", planned);
        if constexpr (!std::is_const_v<Samples>) {
            counts.planned = planned.value_or(0);
            samples.grid_count =
                planned ? static_cast<std::uint32_t>(grid + 1) : samples.grid_count;
        }
        visit_count(visit, name, "_shaded", there, counts.shaded);
        visit_count(visit, name, "_off_screen", there, counts.off_screen);
        visit_count(visit, name, "_covered", there, counts.covered);
        visit_count(visit, name, "_hidden", there, counts.hidden);
    }
    visit("pixels_output", "", samples.pixels_output);
    visit_count(visit, "pixels_hidden", "", true, samples.pixels_hidden);
}

/// When the foveae were computed: of the kind of the latch. `present` and `shown` are not of the
/// file: who reads a runtime's own times adds them.
template <typename Visitor, typename Stamps>
void visit_filtered(Visitor& visit, Stamps& stamps) {
    auto ns = stamps.filtered.known() ? std::optional(stamps.filtered.ns) : std::nullopt;
    visit("filtered", "_ns", ns);
    if constexpr (!std::is_const_v<Stamps>) {
        stamps.filtered = ns ? time::Stamp{*ns, stamps.latch.kind} : time::Stamp{};
    }
}

/// Levels that no front has are read as the last number, which none has either.
template <typename Visitor, typename Level>
void visit_level(Visitor& visit, Level& level) {
    std::optional<std::uint64_t> stored = level;
    visit("quality_level", "", stored);
    if constexpr (!std::is_const_v<Level>) {
        constexpr std::uint64_t kLast = std::numeric_limits<std::uint8_t>::max();
        level = stored ? std::optional(static_cast<std::uint8_t>(std::min(*stored, kLast)))
                       : std::nullopt;
    }
}

template <typename Visitor, typename Record>
void visit_frame(Visitor& visit, Record& record) {
    visit("number", "", record.index);
    visit_stamp(visit, "wake_up", record.stamps.wake_up);
    visit_stamp(visit, "begin", record.stamps.begin);
    visit_stamp(visit, "latch", record.stamps.latch);
    visit_filtered(visit, record.stamps);
    visit_stamp(visit, "submit", record.stamps.submit);
    visit_stamp(visit, "end_frame", record.stamps.end_frame);
    visit_stamp(visit, "gpu_begin", record.stamps.gpu_begin);
    visit_stamp(visit, "gpu_end", record.stamps.gpu_end);
    visit_stamp(visit, "display", record.stamps.display);
    visit("period", "_ns", record.period_ns);
    visit("should_render", "", record.should_render);
    visit("scene_time", "_s", record.scene_time_s);
    visit_pose(visit, "head", record.head);
    visit_stamp(visit, "fovea_latched", record.fovea.latched);
    visit_samples(visit, record.samples);
    visit("budget", "_ns", record.budget_ns);
    visit_level(visit, record.quality_level);
}

/// The columns of `frame` that are NULL until the GPU has finished it.
template <typename Visitor, typename Record>
void visit_gpu(Visitor& visit, Record& record) {
    visit_stamp(visit, "reported_gpu_begin", record.gpu_begin);
    visit_stamp(visit, "reported_gpu_end", record.gpu_end);
    static_assert(kPassColumns.size() == frame::kMostPasses);
    for (std::size_t pass = 0; pass < frame::kMostPasses; ++pass) {
        std::optional<std::int64_t> ns = record.passes[pass];
        visit(kPassColumns[pass], "_ns", ns);
        if constexpr (!std::is_const_v<Record>) {
            record.passes.set(pass, ns);
        }
    }
    visit("pixel_hash", "", record.pixel_hash);
    for (std::size_t pass = 0; pass < frame::kMostPasses; ++pass) {
        std::optional<std::int64_t> ns = record.pass_starts[pass];
        visit(kPassColumns[pass], "_start_ns", ns);
        if constexpr (!std::is_const_v<Record>) {
            record.pass_starts.set(pass, ns);
        }
    }
    visit("gpu_deviation", "_ns", record.clock_deviation_ns);
}

/// What had become of the samples when the frame was recorded; none in older files.
template <typename Visitor, typename Counts>
void visit_gaze_counts(Visitor& visit, Counts& counts) {
    visit("gaze_received", "", counts.received);
    visit("gaze_invalid", "", counts.invalid);
    visit("gaze_lost", "", counts.lost);
    visit("gaze_out_of_order", "", counts.out_of_order);
}

/// The columns of `frame` that are NULL until samples from after its display have come, and for
/// good where its foveae rest on no fresh sample.
template <typename Visitor, typename Error>
void visit_gaze_error(Visitor& visit, Error& error) {
    visit("gaze_error_gap", "", error.gap);
    visit("gaze_error_kind", "", error.kind);
    visit("gaze_error_rad", "", error.radians);
    visit("gaze_error_no_poses_rad", "", error.without_poses_radians);
}

template <typename Visitor, typename Frame, typename Eye, typename View>
void visit_view(Visitor& visit, Frame& frame, Eye& eye, View& view) {
    visit("frame", "", frame);
    visit("eye", "", eye);
    visit_pose(visit, "pose", view.pose);
    visit("left", "_rad", view.fov.left_rad);
    visit("right", "_rad", view.fov.right_rad);
    visit("up", "_rad", view.fov.up_rad);
    visit("down", "_rad", view.fov.down_rad);
    visit("width", "_px", view.width_px);
    visit("height", "_px", view.height_px);
}

template <typename Visitor, typename Frame, typename Eye, typename Fovea>
void visit_fovea(Visitor& visit, Frame& frame, Eye& eye, Fovea& fovea) {
    visit("frame", "", frame);
    visit("eye", "", eye);
    visit("x", "_px", fovea.position.x_px);
    visit("y", "_px", fovea.position.y_px);
    visit("direction", "_x", fovea.direction.x);
    visit("direction", "_y", fovea.direction.y);
    visit("direction", "_z", fovea.direction.z);
    visit("state", "", fovea.state);
    visit("reason", "", fovea.reason);
    visit("sample_sequence", "", fovea.sample_sequence);
    visit_stamp(visit, "sampled", fovea.sampled);
    visit_stamp(visit, "arrived", fovea.arrived);
    visit_clocked(visit, fovea);
    visit("parallax", "_rad", fovea.parallax_rad);
    visit_named(visit, "cause", fovea.cause);
    visit("event", "", fovea.event);
    visit("horizon", "_ns", fovea.horizon_ns);
    visit("uncertainty", "_rad", fovea.uncertainty_rad);
    visit("filter_delay", "_ns", fovea.filter_delay_ns);
}

template <typename Visitor, typename Frame, typename Eye, typename Triangle>
void visit_hidden(Visitor& visit, Frame& frame, Eye& eye, Triangle& triangle) {
    visit("frame", "", frame);
    visit("eye", "", eye);
    constexpr std::array<std::string_view, 3> kCorners{"a", "b", "c"};
    for (std::size_t corner = 0; corner < kCorners.size(); ++corner) {
        visit(kCorners[corner], "_x", triangle.corners[corner].x);
        visit(kCorners[corner], "_y", triangle.corners[corner].y);
    }
}

/// A triangle without corners: not-a-number becomes NULL.
inline gaze::HiddenTriangle no_triangle() {
    gaze::HiddenTriangle triangle;
    triangle.corners.fill(glm::dvec2{std::numeric_limits<double>::quiet_NaN()});
    return triangle;
}

template <typename Visitor, typename Change>
void visit_origin(Visitor& visit, Change& change) {
    visit("frame", "", change.frame);
    visit("announced", "", change.announced);
    visit_pose(visit, "new", change.new_in_old);
}

/// `kind` and `text` are of the type in which the reader or the writer holds text.
template <typename Visitor, typename Time, typename Text>
void visit_event(Visitor& visit, Time& time, Text& kind, Text& text) {
    visit_stamp(visit, "time", time);
    visit("kind", "", kind);
    visit("text", "", text);
}

template <typename Visitor, typename Text>
void visit_named_value(Visitor& visit, Text& name, Text& value) {
    visit("name", "", name);
    visit("value", "", value);
}

}  // namespace gazeloop::session
