#pragma once

#include <array>
#include <string_view>

namespace gazeloop::session {

/// The number in `meta.schema_version`; a change that an older reader cannot cope with raises it.
inline constexpr int kSchemaVersion = 1;

/// The oldest version that is still read.
inline constexpr int kOldestSchemaVersion = 1;

/// Creates the tables in an empty database. SCHEMA.md says what their columns mean.
extern const char* const kCreateTables;

/// Columns and tables that the first files of this version lack, in whichever table they are.
inline constexpr std::array<std::string_view, 5> kLaterColumns{
    "texels_hidden", "pixels_hidden", "ready_ns", "uncertainty_ns", "parallax_rad"};
inline constexpr std::string_view kHiddenTable = "hidden_area";

/// Names in `meta` that the recorder itself keeps.
inline constexpr std::string_view kMetaSchemaVersion = "schema_version";
inline constexpr std::string_view kMetaRecordsDropped = "records_dropped";
inline constexpr std::string_view kMetaClosed = "closed";

/// Values of kMetaClosed.
inline constexpr std::string_view kNotClosed = "no";
inline constexpr std::string_view kClosed = "yes";
inline constexpr std::string_view kWritingFailed = "failed";

}  // namespace gazeloop::session
