#pragma once

#include <cstdint>
#include <optional>

#include "runtime/fixed_text.h"
#include "runtime/frame/event.h"
#include "runtime/frame/frame_record.h"
#include "runtime/frame/passes.h"
#include "runtime/frame/sample_counts.h"
#include "runtime/gaze/fovea_point.h"
#include "runtime/gaze/view.h"

namespace gazeloop::render {

class FrameRenderer;

/// A frame that is about to be drawn.
struct FrameToChoose {
    std::uint64_t index = 0;
    std::int64_t shown_ns = 0;   ///< when the display shows it, or when it began where nobody knows
    bool should_render = true;   ///< the target wants its pictures: somebody can see them
    std::int64_t period_ns = 0;  ///< of the display; 0: unknown
    /// In the replay of a session: the quality level that the frame was drawn at, if it had one.
    std::optional<std::uint8_t> recorded_level{};
};

/// What a chooser has to say of a frame.
struct ChooserEvent {
    frame::EventKind kind;
    FixedText<240> text;
};

/// Decides by whom each frame is drawn, where that changes during a run. Used on the loop's thread.
class FrameChooser {
  public:
    FrameChooser() = default;
    FrameChooser(const FrameChooser&) = delete;
    FrameChooser& operator=(const FrameChooser&) = delete;
    virtual ~FrameChooser() = default;

    /// Null: by nobody. The frame is handed over without pictures, and the display is black.
    virtual FrameRenderer* choose(const FrameToChoose& frame) = 0;

    /// The scene's time in the chosen frame, s, in place of `time_s`: so that the scene moves alike
    /// in pictures that are compared.
    [[nodiscard]] virtual double scene_time_s(double time_s) const { return time_s; }

    /// Where the foveae of the chosen frame are drawn that the gaze has at `latched`.
    [[nodiscard]] virtual gaze::FrameFovea drawn(const gaze::FrameFovea& latched,
                                                 const gaze::StereoView& views) const = 0;

    /// Of the frame that was chosen last; none: the chooser has no levels.
    [[nodiscard]] virtual std::optional<std::uint8_t> quality_level() const { return std::nullopt; }
    /// What was decided for that frame, once; none: nothing is worth telling.
    [[nodiscard]] virtual std::optional<ChooserEvent> take_event() { return std::nullopt; }

    /// Lists of the run, which hold those of every renderer.
    [[nodiscard]] virtual const frame::PassList& passes() const = 0;
    [[nodiscard]] virtual const frame::GridList& grids() const = 0;
    /// What a renderer counted and timed, in the places that its grids and passes have in those.
    [[nodiscard]] virtual frame::SampleCounts in_run(const FrameRenderer& renderer,
                                                     const frame::SampleCounts& counts) const = 0;
    [[nodiscard]] virtual frame::FrameGpuRecord in_run(
        const FrameRenderer& renderer, const frame::FrameGpuRecord& record) const = 0;

    /// The device goes after this: nothing of it may be kept.
    virtual void release() = 0;
};

}  // namespace gazeloop::render
