#pragma once

#include <string_view>

namespace gazeloop::session {

/// The number in `meta.schema_version`; a change that an older reader cannot cope with raises it.
inline constexpr int kSchemaVersion = 1;

/// Creates the tables in an empty database. SCHEMA.md says what their columns mean.
extern const char* const kCreateTables;

/// Names in `meta` that the recorder itself keeps.
inline constexpr std::string_view kMetaSchemaVersion = "schema_version";
inline constexpr std::string_view kMetaRecordsDropped = "records_dropped";
inline constexpr std::string_view kMetaClosed = "closed";

/// Values of kMetaClosed.
inline constexpr std::string_view kNotClosed = "no";
inline constexpr std::string_view kClosed = "yes";
inline constexpr std::string_view kWritingFailed = "failed";

}  // namespace gazeloop::session
