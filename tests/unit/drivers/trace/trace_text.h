#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sstream>
#include <string>
#include <string_view>

#include "drivers/trace/read_trace.h"

namespace gazeloop::drivers {

inline Expected<gaze::GazeTrace> read_text(const std::string& text,
                                           std::string_view format = "auto") {
    std::istringstream in(text);
    return read_trace(in, "gaze.csv", {.format = std::string{format}});
}

/// As messages list them.
inline std::string known_formats() {
    return fmt::format("{}", fmt::join(trace_format_names(), ", "));
}

inline constexpr std::string_view kHtcHeader =
    "time(100ns);time_stamp(ms);eye_valid_L;eye_valid_R;openness_L;openness_R;"
    "gaze_origin_L.x(mm);gaze_origin_L.y(mm);gaze_origin_L.z(mm);"
    "gaze_origin_R.x(mm);gaze_origin_R.y(mm);gaze_origin_R.z(mm);"
    "gaze_direct_L.x;gaze_direct_L.y;gaze_direct_L.z;"
    "gaze_direct_R.x;gaze_direct_R.y;gaze_direct_R.z;"
    "helmet_pos_x;helmet_pos_y;helmet_pos_z;helmet_rot_x;helmet_rot_y;helmet_rot_z";

/// A row of both eyes open and valid that look in these directions (SRanipal's axes).
inline std::string htc_row(long long time_100ns, std::string_view left = "0;0;1",
                           std::string_view right = "0;0;1",
                           std::string_view helmet = "0;0;0;0;0;0") {
    return fmt::format("{};-1;31;31;0.9;0.8;38;2;-37;-32;1;-36;{};{};{}\r\n", time_100ns, left,
                       right, helmet);
}

inline constexpr std::string_view kNativeHeader =
    "sequence,t_device_ns,t_host_ns,"
    "left_valid,left_x,left_y,left_z,left_origin_x_m,left_origin_y_m,left_origin_z_m,"
    "left_openness,left_confidence,"
    "right_valid,right_x,right_y,right_z,right_origin_x_m,right_origin_y_m,right_origin_z_m,"
    "right_openness,right_confidence,"
    "head_x_m,head_y_m,head_z_m,head_qx,head_qy,head_qz,head_qw";

/// A row of both eyes valid and straight ahead.
inline std::string native_row(long long sequence, long long device_ns,
                              std::string_view host_ns = "", std::string_view head = ",,,,,,") {
    return fmt::format("{},{},{},1,0,0,-1,-0.03,0,0,1,0.9,1,0,0,-1,0.03,0,0,1,0.9,{}\n", sequence,
                       device_ns, host_ns, head);
}

}  // namespace gazeloop::drivers
