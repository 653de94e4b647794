#include "runtime/session/column_names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "runtime/session/record_fields.h"

namespace gazeloop::session {
namespace {

constexpr std::uint64_t kFrame = 0;
constexpr gaze::Eye kEye = gaze::Eye::Left;
constexpr std::string_view kText;

}  // namespace

std::string ColumnNames::insert_into(std::string_view table) const {
    const std::vector<std::string_view> parameters(names_.size(), "?");
    return fmt::format("INSERT INTO {} ({}) VALUES ({})", table, fmt::join(names_, ", "),
                       fmt::join(parameters, ", "));
}

std::string ColumnNames::update(std::string_view table, std::string_view key) const {
    return fmt::format("UPDATE {} SET {} = ? WHERE {} = ?", table, fmt::join(names_, " = ?, "),
                       key);
}

ColumnNames named_value_columns() {
    ColumnNames names;
    visit_named_value(names, kText, kText);
    return names;
}

ColumnNames sample_columns() {
    ColumnNames names;
    const gaze::GazeSample sample;
    visit_sample(names, kFrame, sample);
    return names;
}

ColumnNames frame_columns() {
    ColumnNames names;
    const frame::FrameRecord record;
    visit_frame(names, record);
    const frame::GazeCounts counts;
    visit_gaze_counts(names, counts);
    return names;
}

ColumnNames gaze_error_columns() {
    ColumnNames names;
    const frame::GazeError error;
    visit_gaze_error(names, error);
    return names;
}

ColumnNames gpu_columns() {
    ColumnNames names;
    const frame::FrameGpuRecord record;
    visit_gpu(names, record);
    return names;
}

ColumnNames whole_frame_columns() {
    ColumnNames names = frame_columns();
    const frame::GazeError error;
    visit_gaze_error(names, error);
    const frame::FrameGpuRecord record;
    visit_gpu(names, record);
    return names;
}

ColumnNames view_columns() {
    ColumnNames names;
    const gaze::EyeView view;
    visit_view(names, kFrame, kEye, view);
    return names;
}

ColumnNames fovea_columns() {
    ColumnNames names;
    const gaze::FoveaPoint fovea;
    visit_fovea(names, kFrame, kEye, fovea);
    return names;
}

ColumnNames hidden_columns() {
    ColumnNames names;
    const gaze::HiddenTriangle triangle;
    visit_hidden(names, kFrame, kEye, triangle);
    return names;
}

ColumnNames origin_columns() {
    ColumnNames names;
    const gaze::OriginChange change;
    visit_origin(names, change);
    return names;
}

ColumnNames event_columns() {
    ColumnNames names;
    const time::Stamp time;
    visit_event(names, time, kText, kText);
    return names;
}

}  // namespace gazeloop::session
