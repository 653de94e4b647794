#pragma once

#include <string>

#include "runtime/probe/video_result.h"

namespace gazeloop::probe {

/// Measures a video and says what came of it, unless `quiet`, on stdout, or on stderr where `json`
/// is "-". `json`: a file, "-" for stdout, or empty. Whether anything was measured.
/// @throws SetupError as measure_video(), and for a file that cannot be written
[[nodiscard]] bool tell_video(const VideoQuestion& question, const std::string& json, bool quiet);

}  // namespace gazeloop::probe
