#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "runtime/frame/frame_gaze.h"
#include "runtime/frame/frame_record.h"
#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::session {

struct RecordedSample {
    std::uint64_t frame = 0;  ///< the frame that consumed it
    gaze::GazeSample sample;
};

struct RecordedFrame {
    frame::FrameRecord frame;
    frame::FrameGpuRecord gpu;                ///< stamps unknown and no passes if !gpu_known
    bool gpu_known = false;                   ///< the file has the GPU part
    std::optional<frame::GazeCounts> gaze{};  ///< of all samples up to it; none in older files
    std::optional<frame::GazeError> gaze_error{};
};

struct RecordedEvent {
    time::Stamp time;
    std::string kind;
    std::string text;
};

}  // namespace gazeloop::session
