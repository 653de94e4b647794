#include "runtime/session/row_readers.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <utility>

#include "runtime/gaze/direction.h"
#include "runtime/session/record_fields.h"
#include "runtime/session/schema.h"

namespace gazeloop::session {
namespace {

constexpr std::size_t kGazeCountColumns = 4;
constexpr std::size_t kGazeErrorColumns = 4;

/// Moves to the row of one eye in one frame, which must be the next one, and reads it.
template <typename Visit>
void read_eye(TableReader& reader, std::uint64_t frame, gaze::Eye eye, const Visit& visit) {
    std::uint64_t row_frame = 0;
    gaze::Eye row_eye{};
    const bool more = reader.next();
    if (more) {
        visit(row_frame, row_eye);
    }
    if (!more || row_frame != frame || row_eye != eye) {
        reader.fail(fmt::format("the {} eye of frame {} is missing here",
                                gaze::kEyeNames[gaze::index(eye)], frame));
    }
}

}  // namespace

SampleRows::SampleRows(const Database& database, int version)
    : samples_(database, "gaze", kByPosition, sample_columns(), version) {}

bool SampleRows::next() {
    if (!samples_.next()) {
        return false;
    }
    const std::uint64_t frame_before = row_.frame;
    visit_sample(samples_, row_.frame, row_.sample);
    if (row_.frame < frame_before) {
        samples_.fail("was consumed by an earlier frame than the sample before it");
    }
    return true;
}

FrameRows::FrameRows(const Database& database, int version)
    : frames_(database, "frame", kByNumber, whole_frame_columns(), version),
      views_(database, "view", kByFrameAndEye, view_columns(), version),
      foveae_(database, "fovea", kByFrameAndEye, fovea_columns(), version) {}

bool FrameRows::next() {
    if (!frames_.next()) {
        for (TableReader* const reader : {&views_, &foveae_}) {
            if (reader->next()) {
                reader->fail("belongs to no frame");
            }
        }
        return false;
    }
    row_ = {};
    auto& [frame, gpu, gpu_known, gaze, gaze_error] = row_;
    visit_frame(frames_, frame);
    if (frames_.at_null()) {
        frames_.leave_out(kGazeCountColumns);
    } else {
        visit_gaze_counts(frames_, gaze.emplace());
    }
    if (frames_.at_null()) {
        frames_.leave_out(kGazeErrorColumns);
    } else {
        visit_gaze_error(frames_, gaze_error.emplace());
    }
    gpu.index = frame.index;
    gpu_known = !frames_.at_null();
    if (gpu_known) {
        visit_gpu(frames_, gpu);
    }
    for (const gaze::Eye eye : gaze::kEyes) {
        auto& view = frame.views[gaze::index(eye)];
        read_eye(views_, frame.index, eye, [&](auto& row_frame, auto& row_eye) {
            visit_view(views_, row_frame, row_eye, view);
        });
        auto& fovea = frame.fovea.eyes[gaze::index(eye)];
        read_eye(foveae_, frame.index, eye, [&](auto& row_frame, auto& row_eye) {
            visit_fovea(foveae_, row_frame, row_eye, fovea);
        });
    }
    return true;
}

HiddenRows::HiddenRows(const Database& database, int version) {
    if (has_table(database, kHiddenTable)) {
        triangles_.emplace(database, kHiddenTable, kByPosition, hidden_columns(), version);
        look_ahead();
    }
}

void HiddenRows::look_ahead() {
    const std::uint64_t frame_before = ahead_ ? ahead_->frame : 0;
    ahead_.reset();
    if (!triangles_->next()) {
        return;
    }
    HiddenRecord& next = ahead_.emplace();
    visit_hidden(*triangles_, next.frame, next.eye, next.triangle);
    if (next.frame < frame_before) {
        triangles_->fail("is of an earlier frame than the row before it");
    }
}

bool HiddenRows::next() {
    if (!ahead_) {
        return false;
    }
    const auto meshes = std::make_shared<gaze::PerEye<gaze::HiddenMesh>>();
    row_ = {ahead_->frame, meshes};
    while (ahead_ && ahead_->frame == row_.frame) {
        if (!std::isnan(ahead_->triangle.corners[0].x)) {
            (*meshes)[gaze::index(ahead_->eye)].push_back(ahead_->triangle);
        }
        look_ahead();
    }
    return true;
}

OriginRows::OriginRows(const Database& database, int version) {
    if (has_table(database, kOriginTable)) {
        changes_.emplace(database, kOriginTable, kByPosition, origin_columns(), version);
    }
}

bool OriginRows::next() {
    if (!changes_ || !changes_->next()) {
        return false;
    }
    const std::uint64_t frame_before = row_.frame;
    visit_origin(*changes_, row_);
    if (std::exchange(any_, true) && row_.frame <= frame_before) {
        changes_->fail("is not of a later frame than the row before it");
    }
    constexpr double kRounding = 1e-3;
    if (!gaze::is_finite(row_.new_in_old.position_m) ||
        !(std::abs(glm::length(row_.new_in_old.orientation) - 1.0) < kRounding)) {
        changes_->fail("is no pose");
    }
    return true;
}

EventRows::EventRows(const Database& database, int version)
    : events_(database, "event", kByPosition, event_columns(), version) {}

bool EventRows::next() {
    if (!events_.next()) {
        return false;
    }
    visit_event(events_, row_.time, row_.kind, row_.text);
    return true;
}

}  // namespace gazeloop::session
