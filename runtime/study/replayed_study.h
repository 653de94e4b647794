#pragma once

#include <memory>
#include <vector>

#include "runtime/render/frame_chooser.h"
#include "runtime/session/study_rows.h"
#include "runtime/study/stimuli.h"

namespace gazeloop::study {

/// Has each frame of a recorded study drawn as it was.
class ReplayedStudy final : public render::FrameChooser {
  public:
    /// By `trial` rows of the session. Errors (BadInput): settings that are not KEY=VALUE.
    static Expected<std::unique_ptr<ReplayedStudy>> create(
        const std::vector<session::TrialRow>& rows);

    /// One of each method in each scene, for Stimuli, which must be set before the first frame.
    [[nodiscard]] std::vector<Stimulus> samples() const;
    void set_stimuli(std::unique_ptr<Stimuli> stimuli) { stimuli_ = std::move(stimuli); }

    render::FrameRenderer* choose(const render::FrameToChoose& frame) override;
    [[nodiscard]] gaze::FrameFovea drawn(const gaze::FrameFovea& latched,
                                         const gaze::StereoView& views) const override;
    [[nodiscard]] const frame::PassList& passes() const override {
        return stimuli_->lists().passes();
    }
    [[nodiscard]] const frame::GridList& grids() const override {
        return stimuli_->lists().grids();
    }
    [[nodiscard]] frame::SampleCounts in_run(const render::FrameRenderer& renderer,
                                             const frame::SampleCounts& counts) const override {
        return stimuli_->lists().in_run(renderer, counts);
    }
    [[nodiscard]] frame::FrameGpuRecord in_run(const render::FrameRenderer& renderer,
                                               const frame::FrameGpuRecord& record) const override {
        return stimuli_->lists().in_run(renderer, record);
    }
    void release() override { stimuli_.reset(); }

  private:
    struct Shown {
        std::uint64_t first_frame = 0;
        bool follows_gaze = true;
        Stimulus stimulus;  ///< no method: black
    };

    std::vector<Shown> shown_;
    std::size_t now_ = 0;
    std::unique_ptr<Stimuli> stimuli_;
};

}  // namespace gazeloop::study
