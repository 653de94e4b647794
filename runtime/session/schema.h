#pragma once

#include <array>
#include <string_view>

namespace gazeloop::session {

/// The number in `meta.schema_version`. A change that an older reader cannot read raises it.
inline constexpr int kSchemaVersion = 2;

/// The oldest version that is still read.
inline constexpr int kOldestSchemaVersion = 1;

/// Creates the tables in an empty database. SCHEMA.md says what their columns mean.
extern const char* const kCreateTables;

/// Creates those of a study, which other sessions do not have.
extern const char* const kCreateStudyTables;

/// Columns that the first files of version 1 lack, in whichever table; then a table that they lack.
inline constexpr auto kLaterColumns = std::to_array<std::string_view>({"texels_hidden",
                                                                       "pixels_hidden",
                                                                       "ready_ns",
                                                                       "uncertainty_ns",
                                                                       "parallax_rad",
                                                                       "filtered_ns",
                                                                       "gpu_deviation_ns",
                                                                       "pass_0_start_ns",
                                                                       "pass_1_start_ns",
                                                                       "pass_2_start_ns",
                                                                       "pass_3_start_ns",
                                                                       "pass_4_start_ns",
                                                                       "pass_5_start_ns",
                                                                       "pass_6_start_ns",
                                                                       "pass_7_start_ns",
                                                                       "pass_8_start_ns",
                                                                       "pass_9_start_ns",
                                                                       "pass_10_start_ns",
                                                                       "pass_11_start_ns",
                                                                       "gaze_received",
                                                                       "gaze_invalid",
                                                                       "gaze_lost",
                                                                       "gaze_out_of_order",
                                                                       "gaze_error_gap",
                                                                       "gaze_error_kind",
                                                                       "gaze_error_rad",
                                                                       "gaze_error_no_poses_rad",
                                                                       "budget_ns",
                                                                       "quality_level",
                                                                       "left_cov_xx_rad2",
                                                                       "left_cov_xy_rad2",
                                                                       "left_cov_yy_rad2",
                                                                       "right_cov_xx_rad2",
                                                                       "right_cov_xy_rad2",
                                                                       "right_cov_yy_rad2",
                                                                       "processing",
                                                                       "tracker_gone",
                                                                       "cause",
                                                                       "uncertainty_rad",
                                                                       "event",
                                                                       "horizon_ns",
                                                                       "filter_delay_ns"});
inline constexpr std::string_view kTrialTable = "trial";
inline constexpr std::string_view kResponseTable = "response";
inline constexpr std::string_view kHiddenTable = "hidden_area";
inline constexpr std::string_view kOriginTable =
    "origin";  ///< the first files of version 2 lack it

/// Version 1 named the columns of `frame` after the two methods that it knew. This says from which
/// of them a column of today is read. Other columns of grids and passes are NULL in such a file.
struct FormerColumn {
    std::string_view name;
    std::string_view before;
};
inline constexpr std::array kFormerColumns{FormerColumn{"grid_0_planned", "texels_planned"},
                                           FormerColumn{"grid_0_shaded", "texels_shaded"},
                                           FormerColumn{"grid_0_off_screen", "texels_off_screen"},
                                           FormerColumn{"grid_0_covered", "texels_under_disc"},
                                           FormerColumn{"grid_0_hidden", "texels_hidden"},
                                           FormerColumn{"grid_1_planned", "pixels_direct"},
                                           FormerColumn{"grid_1_shaded", "pixels_direct"},
                                           FormerColumn{"pass_0_ns", "full_ns"},
                                           FormerColumn{"pass_1_ns", "pass_i_ns"},
                                           FormerColumn{"pass_2_ns", "resolve_ns"},
                                           FormerColumn{"pass_3_ns", "disc_ns"}};
inline constexpr std::string_view kFormerPasses = "full pass_i resolve disc";
inline constexpr std::string_view kFormerGrids = "lp picture";

/// Names in `meta` that the recorder itself keeps.
inline constexpr std::string_view kMetaSchemaVersion = "schema_version";
inline constexpr std::string_view kMetaRecordsDropped = "records_dropped";
inline constexpr std::string_view kMetaClosed = "closed";
inline constexpr std::string_view kMetaPasses = "passes";
inline constexpr std::string_view kMetaGrids = "grids";

/// Values of kMetaClosed.
inline constexpr std::string_view kNotClosed = "no";
inline constexpr std::string_view kClosed = "yes";
inline constexpr std::string_view kWritingFailed = "failed";

}  // namespace gazeloop::session
