#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/frame/frame_observer.h"
#include "runtime/render/frame_chooser.h"
#include "runtime/session/session_recorder.h"
#include "runtime/study/stimuli.h"
#include "runtime/study/subject_input.h"
#include "runtime/study/trial_clock.h"

namespace gazeloop::study {

/// What draws the reference; with `settings` of all pictures and of the conditions, levels of all
/// factors but the first.
[[nodiscard]] Stimulus reference_stimulus(const Plan& plan, const Trial& trial);
/// What draws a trial's test at a level of the first factor.
[[nodiscard]] Stimulus test_stimulus(const Plan& plan, const Trial& trial, double level);

/// Shows a study's trials in the loop: chooses by whom each frame is drawn, takes the subject's
/// presses and the eyes' states to the trials' clock, and records trials and responses. Follows the
/// times at which frames are shown.
class StudyRun final : public render::FrameChooser, public frame::FrameObserver {
  public:
    /// What is said to whoever conducts the study; one line each.
    using Say = std::function<void(const std::string&)>;

    /// All must outlive this. The recorder may be set later, before the first frame.
    StudyRun(const Plan& plan, TrialQueue& queue, unsigned subject, SubjectInput& input, Say say);
    void set_stimuli(std::unique_ptr<Stimuli> stimuli) { stimuli_ = std::move(stimuli); }
    void set_recorder(session::SessionRecorder* recorder) { recorder_ = recorder; }
    /// One of each method, for Stimuli.
    [[nodiscard]] std::vector<Stimulus> samples() const;

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
    void on_frame(const frame::FrameRecord& record) override;

    [[nodiscard]] bool over() const { return queue_.next() == nullptr; }
    /// Whether pictures were missed again and again: this machine is too slow for the plan's times.
    [[nodiscard]] bool too_slow() const { return clock_.restarts() >= kMostRestarts; }
    [[nodiscard]] std::size_t answers() const { return answers_; }

  private:
    static constexpr unsigned kMostRestarts = 5;

    void take_presses(std::int64_t now_ns);
    void take_responses(std::uint64_t frame);
    void record_shown(std::uint64_t frame, const Shown& shown, const Stimulus& stimulus);
    [[nodiscard]] Stimulus stimulus_of(const Shown& shown) const;
    void make_ready();

    const Plan& plan_;
    TrialQueue& queue_;
    unsigned subject_;
    SubjectInput& input_;
    Say say_;
    TrialClock clock_;
    std::unique_ptr<Stimuli> stimuli_;
    session::SessionRecorder* recorder_ = nullptr;
    std::optional<Shown> last_;
    std::optional<unsigned> last_trial_;
    Stimulus last_stimulus_;
    std::size_t answers_ = 0;
};

}  // namespace gazeloop::study
