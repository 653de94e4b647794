#include "runtime/session/info_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <utility>
#include <vector>

#include "runtime/session/column_names.h"
#include "runtime/session/record_fields.h"
#include "runtime/session/schema.h"
#include "runtime/session/table_reader.h"

namespace gazeloop::session {
namespace {

std::vector<NamedValue> read_named_values(const Database& database, std::string_view table) {
    std::vector<NamedValue> values;
    TableReader reader(database, table, kByPosition, named_value_columns(), kSchemaVersion);
    while (reader.next()) {
        NamedValue& value = values.emplace_back();
        visit_named_value(reader, value.name, value.value);
    }
    return values;
}

/// What the recorder itself keeps in meta.
const std::string& kept(const std::vector<NamedValue>& meta, std::string_view name) {
    const auto found = std::ranges::find(meta, name, &NamedValue::name);
    if (found == meta.end()) {
        throw FormatError(fmt::format("not a session: table meta has no {}", name));
    }
    return found->value;
}

template <typename T>
T kept_number(const std::vector<NamedValue>& meta, std::string_view name) {
    const std::string& text = kept(meta, name);
    T number = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc{} || stop != end) {
        throw FormatError(fmt::format("table meta: {} is '{}', which is no number", name, text));
    }
    return number;
}

frame::NameList names_in(std::string_view text, std::string_view name, std::size_t most) {
    auto names = frame::NameList::parse(text, most);
    if (!names) {
        throw FormatError(fmt::format("table meta: {} is {}", name, names.error().message));
    }
    return *std::move(names);
}

void require_known_version(int version) {
    if (version > kSchemaVersion) {
        throw FormatError(fmt::format(
            "has schema version {}, and this program reads up to version {}; use a newer gazeloop",
            version, kSchemaVersion));
    }
    if (version < kOldestSchemaVersion) {
        throw FormatError(fmt::format(
            "has schema version {}, and this program reads versions from {} on; use an older "
            "gazeloop",
            version, kOldestSchemaVersion));
    }
}

}  // namespace

SessionInfo read_info(const Database& database) {
    SessionInfo info;
    const std::vector<NamedValue> meta = read_named_values(database, "meta");
    info.schema_version = kept_number<int>(meta, kMetaSchemaVersion);
    require_known_version(info.schema_version);
    const bool named = info.schema_version > 1;  // before, all runs had the same passes and grids
    info.header.passes =
        names_in(named ? kept(meta, kMetaPasses) : kFormerPasses, kMetaPasses, frame::kMostPasses);
    info.header.grids =
        names_in(named ? kept(meta, kMetaGrids) : kFormerGrids, kMetaGrids, frame::kMostGrids);
    info.records_dropped = kept_number<std::uint64_t>(meta, kMetaRecordsDropped);
    const std::string& closed = kept(meta, kMetaClosed);
    info.closed_cleanly = closed == kClosed;
    info.writing_failed = closed == kWritingFailed;
    info.header.meta = meta_of(meta);
    info.header.config = read_named_values(database, "config");
    info.header.device = read_named_values(database, "device");
    return info;
}

}  // namespace gazeloop::session
