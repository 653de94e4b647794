#pragma once

#include <cstdint>
#include <string>

#include "runtime/frame/frame_record.h"
#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::session {

struct RecordedSample {
    std::uint64_t frame = 0;  ///< the frame that consumed it
    gaze::GazeSample sample;
};

struct RecordedFrame {
    frame::FrameRecord frame;
    frame::FrameGpuRecord gpu;  ///< with unknown stamps and no passes where the GPU part is missing
    bool gpu_known = false;     ///< the GPU part is there
};

struct RecordedEvent {
    time::Stamp time;
    std::string kind;
    std::string text;
};

}  // namespace gazeloop::session
