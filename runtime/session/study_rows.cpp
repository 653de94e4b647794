#include "runtime/session/study_rows.h"

#include "runtime/session/open_session.h"
#include "runtime/session/reading_error.h"
#include "runtime/session/schema.h"
#include "runtime/session/table_reader.h"

namespace gazeloop::session {
namespace {

template <typename Row, typename Visit>
Expected<std::vector<Row>> read(const OpenSession& session, std::string_view table,
                                const Visit& visit) {
    try {
        std::vector<Row> rows;
        if (!has_table(session.database(), table)) {
            return rows;
        }
        ColumnNames columns;
        Row row;
        visit(columns, row);
        TableReader reader(session.database(), table, kByPosition, columns, kSchemaVersion);
        while (reader.next()) {
            visit(reader, row);
            rows.push_back(row);
        }
        return rows;
    } catch (...) {
        return std::unexpected(reading_error(session.file()));
    }
}

}  // namespace

Expected<std::vector<TrialRow>> read_trials(const OpenSession& session) {
    auto rows = read<TrialRow>(session, kTrialTable,
                               [](auto& visit, auto& row) { visit_trial(visit, row); });
    for (std::size_t i = 1; rows && i < rows->size(); ++i) {
        if ((*rows)[i].first_frame < (*rows)[i - 1].first_frame) {
            return std::unexpected(bad_session(
                session.file(), "trial: begins at an earlier frame than the row before it"));
        }
    }
    return rows;
}

Expected<std::vector<ResponseRow>> read_responses(const OpenSession& session) {
    return read<ResponseRow>(session, kResponseTable,
                             [](auto& visit, auto& row) { visit_response(visit, row); });
}

}  // namespace gazeloop::session
