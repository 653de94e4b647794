#include "runtime/report/page/eye_event_table.h"

#include "runtime/report/row_names.h"

namespace gazeloop::report::page {
namespace {

void add(Table& table, const char* heading, const RowName& of,
         const std::vector<SessionRow>& rows) {
    table.rows.push_back({.label = heading, .heading = true, .show_s = {}});
    for (const SessionRow& row : rows) {
        table.rows.push_back(quantity_line(row));
        table.rows.back().key = of.key + "_" + row.name.key;
    }
}

}  // namespace

Table eye_event_table(const EyeEventRows& rows, const Percentiles& percentiles) {
    Table table{.heads = quantity_heads(percentiles), .rows = {}};
    table.heads.front().text = "when the frame was shown";
    if (rows.any()) {
        add(table, "gaze age when shown, milliseconds", kGazeAgeAtDisplay, rows.ages);
        add(table, "gaze error when shown, degrees", kGazeError, rows.errors);
    }
    return table;
}

}  // namespace gazeloop::report::page
