#include "runtime/session/schema.h"

namespace gazeloop::session {

// Doubles are declared ANY, because a column declared REAL does not keep the sign of -0.0.
const char* const kCreateTables = R"sql(
CREATE TABLE meta (
    position INTEGER PRIMARY KEY,
    name     TEXT NOT NULL UNIQUE,
    value    TEXT NOT NULL
) STRICT;

CREATE TABLE config (
    position INTEGER PRIMARY KEY,
    name     TEXT NOT NULL UNIQUE,
    value    TEXT NOT NULL
) STRICT;

CREATE TABLE device (
    position INTEGER PRIMARY KEY,
    name     TEXT NOT NULL UNIQUE,
    value    TEXT NOT NULL
) STRICT;

CREATE TABLE gaze (
    position          INTEGER PRIMARY KEY,
    frame             INTEGER NOT NULL,
    sequence          INTEGER NOT NULL,
    device_ns         INTEGER NOT NULL,
    sampled_ns        INTEGER NOT NULL,
    sampled_kind      INTEGER NOT NULL,
    arrived_ns        INTEGER NOT NULL,
    arrived_kind      INTEGER NOT NULL,
    left_origin_x_m   ANY,
    left_origin_y_m   ANY,
    left_origin_z_m   ANY,
    left_direction_x  ANY,
    left_direction_y  ANY,
    left_direction_z  ANY,
    left_openness     ANY,
    left_confidence   ANY,
    left_valid        INTEGER NOT NULL,
    right_origin_x_m  ANY,
    right_origin_y_m  ANY,
    right_origin_z_m  ANY,
    right_direction_x ANY,
    right_direction_y ANY,
    right_direction_z ANY,
    right_openness    ANY,
    right_confidence  ANY,
    right_valid       INTEGER NOT NULL,
    has_head          INTEGER NOT NULL,
    head_qw           ANY,
    head_qx           ANY,
    head_qy           ANY,
    head_qz           ANY,
    head_x_m          ANY,
    head_y_m          ANY,
    head_z_m          ANY,
    ready_ns          INTEGER,
    uncertainty_ns    INTEGER,
    parallax_rad      ANY,
    left_cov_xx_rad2  ANY,
    left_cov_xy_rad2  ANY,
    left_cov_yy_rad2  ANY,
    right_cov_xx_rad2 ANY,
    right_cov_xy_rad2 ANY,
    right_cov_yy_rad2 ANY
) STRICT;

CREATE TABLE frame (
    number                  INTEGER PRIMARY KEY,
    wake_up_ns              INTEGER NOT NULL,
    wake_up_kind            INTEGER NOT NULL,
    begin_ns                INTEGER NOT NULL,
    begin_kind              INTEGER NOT NULL,
    latch_ns                INTEGER NOT NULL,
    latch_kind              INTEGER NOT NULL,
    submit_ns               INTEGER NOT NULL,
    submit_kind             INTEGER NOT NULL,
    end_frame_ns            INTEGER NOT NULL,
    end_frame_kind          INTEGER NOT NULL,
    gpu_begin_ns            INTEGER NOT NULL,
    gpu_begin_kind          INTEGER NOT NULL,
    gpu_end_ns              INTEGER NOT NULL,
    gpu_end_kind            INTEGER NOT NULL,
    display_ns              INTEGER NOT NULL,
    display_kind            INTEGER NOT NULL,
    period_ns               INTEGER NOT NULL,
    should_render           INTEGER NOT NULL,
    scene_time_s            ANY,
    head_qw                 ANY,
    head_qx                 ANY,
    head_qy                 ANY,
    head_qz                 ANY,
    head_x_m                ANY,
    head_y_m                ANY,
    head_z_m                ANY,
    fovea_latched_ns        INTEGER NOT NULL,
    fovea_latched_kind      INTEGER NOT NULL,
    grid_0_planned          INTEGER,
    grid_0_shaded           INTEGER,
    grid_0_off_screen       INTEGER,
    grid_0_covered          INTEGER,
    grid_0_hidden           INTEGER,
    grid_1_planned          INTEGER,
    grid_1_shaded           INTEGER,
    grid_1_off_screen       INTEGER,
    grid_1_covered          INTEGER,
    grid_1_hidden           INTEGER,
    grid_2_planned          INTEGER,
    grid_2_shaded           INTEGER,
    grid_2_off_screen       INTEGER,
    grid_2_covered          INTEGER,
    grid_2_hidden           INTEGER,
    grid_3_planned          INTEGER,
    grid_3_shaded           INTEGER,
    grid_3_off_screen       INTEGER,
    grid_3_covered          INTEGER,
    grid_3_hidden           INTEGER,
    grid_4_planned          INTEGER,
    grid_4_shaded           INTEGER,
    grid_4_off_screen       INTEGER,
    grid_4_covered          INTEGER,
    grid_4_hidden           INTEGER,
    grid_5_planned          INTEGER,
    grid_5_shaded           INTEGER,
    grid_5_off_screen       INTEGER,
    grid_5_covered          INTEGER,
    grid_5_hidden           INTEGER,
    grid_6_planned          INTEGER,
    grid_6_shaded           INTEGER,
    grid_6_off_screen       INTEGER,
    grid_6_covered          INTEGER,
    grid_6_hidden           INTEGER,
    grid_7_planned          INTEGER,
    grid_7_shaded           INTEGER,
    grid_7_off_screen       INTEGER,
    grid_7_covered          INTEGER,
    grid_7_hidden           INTEGER,
    pixels_output           INTEGER NOT NULL,
    pixels_hidden           INTEGER,
    budget_ns               INTEGER,
    quality_level           INTEGER,
    reported_gpu_begin_ns   INTEGER,
    reported_gpu_begin_kind INTEGER,
    reported_gpu_end_ns     INTEGER,
    reported_gpu_end_kind   INTEGER,
    pass_0_ns               INTEGER,
    pass_1_ns               INTEGER,
    pass_2_ns               INTEGER,
    pass_3_ns               INTEGER,
    pass_4_ns               INTEGER,
    pass_5_ns               INTEGER,
    pass_6_ns               INTEGER,
    pass_7_ns               INTEGER,
    pass_8_ns               INTEGER,
    pass_9_ns               INTEGER,
    pass_10_ns              INTEGER,
    pass_11_ns              INTEGER,
    pixel_hash              INTEGER
) STRICT;

CREATE TABLE view (
    frame     INTEGER NOT NULL,
    eye       INTEGER NOT NULL,
    pose_qw   ANY,
    pose_qx   ANY,
    pose_qy   ANY,
    pose_qz   ANY,
    pose_x_m  ANY,
    pose_y_m  ANY,
    pose_z_m  ANY,
    left_rad  ANY,
    right_rad ANY,
    up_rad    ANY,
    down_rad  ANY,
    width_px  INTEGER NOT NULL,
    height_px INTEGER NOT NULL,
    PRIMARY KEY (frame, eye)
) STRICT, WITHOUT ROWID;

CREATE TABLE fovea (
    frame           INTEGER NOT NULL,
    eye             INTEGER NOT NULL,
    x_px            ANY,
    y_px            ANY,
    direction_x     ANY,
    direction_y     ANY,
    direction_z     ANY,
    state           INTEGER NOT NULL,
    reason          INTEGER NOT NULL,
    sample_sequence INTEGER NOT NULL,
    sampled_ns      INTEGER NOT NULL,
    sampled_kind    INTEGER NOT NULL,
    arrived_ns      INTEGER NOT NULL,
    arrived_kind    INTEGER NOT NULL,
    ready_ns        INTEGER,
    uncertainty_ns  INTEGER,
    parallax_rad    ANY,
    event           INTEGER,
    horizon_ns      INTEGER,
    uncertainty_rad ANY,
    filter_state    BLOB,
    PRIMARY KEY (frame, eye)
) STRICT, WITHOUT ROWID;

CREATE TABLE hidden_area (
    position INTEGER PRIMARY KEY,
    frame    INTEGER NOT NULL,
    eye      INTEGER NOT NULL,
    a_x      ANY,
    a_y      ANY,
    b_x      ANY,
    b_y      ANY,
    c_x      ANY,
    c_y      ANY
) STRICT;

CREATE TABLE origin (
    position  INTEGER PRIMARY KEY,
    frame     INTEGER NOT NULL,
    announced INTEGER NOT NULL,
    new_qw    ANY,
    new_qx    ANY,
    new_qy    ANY,
    new_qz    ANY,
    new_x_m   ANY,
    new_y_m   ANY,
    new_z_m   ANY
) STRICT;

CREATE TABLE event (
    position  INTEGER PRIMARY KEY,
    time_ns   INTEGER NOT NULL,
    time_kind INTEGER NOT NULL,
    kind      TEXT NOT NULL,
    text      TEXT NOT NULL
) STRICT;
)sql";

}  // namespace gazeloop::session
