#pragma once

#include "drivers/trace/trace_format.h"

namespace gazeloop::drivers {

/// gaze.csv of Pupil Labs' Neon and Invisible, as Pupil Cloud and Neon Player export it: one
/// direction for both eyes, by azimuth (positive right) and elevation (positive up) from the scene
/// camera, whose axes are taken for the head's. Times are UTC in ns.
///
/// Of a file with several recordings (`recording id`) the first is read. Gaze is not vouched for in
/// a blink (column `blink id`, else blinks.csv beside it) and where the glasses are not worn
/// (`worn`). What stands beside it is read where it is there:
/// - 3d_eye_states.csv: the eyeballs' centres. Its optical axes are not gaze: the line of sight is
///   some 5 degrees off them, so they are not used.
/// - imu.csv: its quaternion is the head's orientation, interpolated at the times of the gaze, no
///   further than 50 ms from a reading. The scene camera is turned by 102 degrees about X against
///   the IMU. The IMU's world has Y north and Z up; ours has -Z north. Nobody records the head's
///   position: it stays at the origin.
/// - info.json: its gaze_mode, binocular or monocular, is noted.
///
/// Source: Pupil Labs, "Data Streams" and "IMU Transformations" of Neon's documentation.
[[nodiscard]] const TraceFormat& pupil_labs();

}  // namespace gazeloop::drivers
