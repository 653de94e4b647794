#pragma once

#include <cstdint>
#include <variant>

#include "runtime/fixed_text.h"
#include "runtime/frame/frame_record.h"
#include "runtime/gaze/gaze_sample.h"
#include "runtime/gaze/hidden_mesh.h"
#include "runtime/gaze/origin_change.h"
#include "runtime/session/study_rows.h"

namespace gazeloop::session {

struct SampleRecord {
    std::uint64_t frame = 0;  ///< the frame that consumed it
    gaze::GazeSample sample;
};

struct EventRecord {
    time::Stamp time;
    FixedText<32> kind;
    FixedText<240> text;
};

/// One triangle of what the views hide from a frame on. Has no corners if they hide nothing.
struct HiddenRecord {
    std::uint64_t frame = 0;
    gaze::Eye eye = gaze::Eye::Left;
    gaze::HiddenTriangle triangle;
};

/// What the loop hands to the recorder's thread.
using Record = std::variant<SampleRecord, frame::FrameRecord, frame::FrameGpuRecord, EventRecord,
                            HiddenRecord, gaze::OriginChange, TrialRecord, ResponseRecord>;

}  // namespace gazeloop::session
