#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "runtime/frame/frame_record.h"
#include "runtime/report/perfetto/kind_texts.h"
#include "runtime/report/perfetto/tracks.h"
#include "runtime/report/perfetto/unshown.h"

namespace gazeloop::report::perfetto {

/// Draws what each eye's fovea rests on: one slice for as long as frames follow each other in the
/// same state. Slices, not Perfetto's state tracks, which readers know only from version 57 on.
class GazeStates {
  public:
    GazeStates(TraceWriter& writer, Tracks& tracks, Unshown& unshown);

    /// In the order of their indices. A frame that was not rendered, or is lacking, ends the state.
    void add(const frame::FrameRecord& record);
    void finish();

  private:
    struct Open {
        gaze::FoveaState state{};
        gaze::LossReason reason{};
        friend bool operator==(const Open&, const Open&) = default;
    };
    struct EyeTrack {
        Subject subject{};
        std::optional<Open> open{};
        std::int64_t last_ns = 0;  ///< of the last event, or frame, on the track
    };

    void end(EyeTrack& eye, std::int64_t ns);
    void begin(EyeTrack& eye, const Open& state, const time::Stamp& from);

    TraceWriter& writer_;
    Tracks& tracks_;
    Unshown& unshown_;
    KeyId reason_;
    KeyId kind_;
    std::array<NameId, gaze::kFoveaStateNames.size()> states_{};
    std::array<TextId, gaze::kLossReasonNames.size()> reasons_{};
    KindTexts kinds_;
    std::array<EyeTrack, 2> eyes_{{{.subject = Subject::LeftEye}, {.subject = Subject::RightEye}}};
    std::optional<std::uint64_t> last_index_;
};

}  // namespace gazeloop::report::perfetto
