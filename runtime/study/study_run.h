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

/// What draws the reference; with `settings` of all pictures, and of the conditions (levels of all
/// factors but the first) those of scene and camera, or all where it is the method's own best
/// level.
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
    /// One of each method in each scene, for Stimuli.
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
    /// Of the picture that is shown, so that the scene moves alike in all of a trial.
    [[nodiscard]] double scene_time_s(double /*time_s*/) const override { return picture_s_; }
    void on_frame(const frame::FrameRecord& record) override;

    [[nodiscard]] bool over() const { return queue_.next() == nullptr; }
    /// Whether pictures were missed again and again: this machine is too slow for the plan's times.
    [[nodiscard]] bool too_slow() const { return clock_.restarts() >= kMostRestarts; }
    /// Answers that are kept: a program that is killed has them.
    [[nodiscard]] std::size_t answers() const { return answers_; }
    /// Trials that the next sitting has.
    [[nodiscard]] std::size_t left() const { return queue_.left() + (lost_ ? 1 : 0); }
    /// Whether answers can no longer be kept: the disk is full, or the recording is gone.
    [[nodiscard]] bool cannot_keep() const { return cannot_keep_; }
    [[nodiscard]] bool nobody_answers() const { return input_.ended(); }

  private:
    static constexpr unsigned kMostRestarts = 5;

    void take_presses(std::int64_t now_ns);
    void take_responses(std::uint64_t frame);
    [[nodiscard]] bool keep(const Response& response, std::uint64_t frame);
    void tell(const Response& response) const;
    void begin_picture(const Shown& shown, std::optional<unsigned> trial, std::int64_t now_ns);
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
    unsigned last_restarts_ = 0;
    std::int64_t picture_since_ns_ = 0;
    double picture_s_ = 0.0;
    std::size_t answers_ = 0;
    bool cannot_keep_ = false;
    bool lost_ = false;  ///< the last answer
};

}  // namespace gazeloop::study
