#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gazeloop::session {

/// The columns of a record, in the order in which its fields are visited, and SQL that names them.
class ColumnNames {
  public:
    /// Visits a field of a record (see record_fields.h).
    template <typename Field>
    void operator()(std::string_view head, std::string_view tail, const Field&) {
        names_.push_back(std::string(head) + std::string(tail));
    }
    [[nodiscard]] std::string insert_into(std::string_view table) const;
    /// Sets every column of one row. The parameter after the columns' is the row's `key`.
    [[nodiscard]] std::string update(std::string_view table, std::string_view key) const;
    [[nodiscard]] std::span<const std::string> names() const { return names_; }

  private:
    std::vector<std::string> names_;
};

ColumnNames named_value_columns();  ///< of meta, config and device
ColumnNames sample_columns();       ///< of gaze
ColumnNames frame_columns();        ///< of frame, as it is inserted: its own, counts of samples
ColumnNames gpu_columns();          ///< of frame, only the GPU part
ColumnNames gaze_error_columns();   ///< of frame, what samples that come later tell
ColumnNames whole_frame_columns();  ///< all of frame: its own, counts of samples, error, GPU part
ColumnNames view_columns();
ColumnNames fovea_columns();
ColumnNames event_columns();
ColumnNames hidden_columns();  ///< of hidden_area
ColumnNames origin_columns();

}  // namespace gazeloop::session
