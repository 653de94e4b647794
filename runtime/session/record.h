#pragma once

#include <cstdint>
#include <variant>

#include "runtime/gaze/gaze_sample.h"
#include "runtime/latency/frame_record.h"
#include "runtime/session/fixed_text.h"

namespace gazeloop::session {

struct SampleRecord {
    std::uint64_t frame = 0;  ///< the frame that consumed it
    gaze::GazeSample sample;
};

struct EventRecord {
    latency::Stamp time;
    FixedText<32> kind;
    FixedText<240> text;
};

/// What the loop hands to the recorder's thread.
using Record =
    std::variant<SampleRecord, latency::FrameRecord, latency::FrameGpuRecord, EventRecord>;

}  // namespace gazeloop::session
