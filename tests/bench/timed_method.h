#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "runtime/render/off_screen.h"

namespace gazeloop::bench {

/// One method on one scene, frame after frame, each finished before the next: how long its frames
/// take, in rounds over the same frames.
class TimedMethod {
  public:
    /// The scene must outlive this. `frames` a round.
    TimedMethod(const vulkan::Context& context, std::string name, scene::Scene& scene,
                const render::MakePasses& passes, const render::RendererConfig& config,
                std::size_t frames);

    /// Compiles what the first frame would.
    void warm_up(const vulkan::Context& context, const gaze::StereoView& views);
    /// Renders frame `index` of a round; the view's targets are this one's own.
    void frame(std::size_t index, render::FrameView view, const gaze::FrameFovea& fovea);

    [[nodiscard]] const std::string& name() const { return name_; }
    /// Cells shaded per frame, both eyes.
    [[nodiscard]] double samples() const { return samples_ / static_cast<double>(frames_); }
    /// Of each frame of a round, the median of the rounds.
    [[nodiscard]] std::vector<double> frame_ms() const;
    /// Mean of those.
    [[nodiscard]] double ms() const;
    /// Likewise, in processor time of this process from before a frame to its end: of software
    /// drivers what ms() is on an idle machine, times its cores.
    [[nodiscard]] double processor_ms() const;
    /// Likewise, on the wall, with all that a frame waits for.
    [[nodiscard]] std::vector<double> frame_elapsed_ms() const;
    /// Likewise, of what goes before the gaze is read: a scene's own work, and what that waits for.
    [[nodiscard]] std::vector<double> frame_begin_ms() const;
    [[nodiscard]] const frame::PassList& passes() const { return renderer_->passes(); }
    /// Mean of all frames.
    [[nodiscard]] double pass_ms(std::size_t pass) const {
        return pass_ms_.at(pass) / static_cast<double>(frames_);
    }
    /// 0 for a pass that there is not.
    [[nodiscard]] double pass_ms(std::string_view pass) const;
    /// Of the last frame.
    [[nodiscard]] const foveation::EyePlan& plan(gaze::Eye eye) const {
        return renderer_->last_plan(eye);
    }
    [[nodiscard]] render::LinearPicture picture(const vulkan::Context& context,
                                                gaze::Eye eye) const;

  private:
    std::string name_;
    render::OffScreenTargets targets_;
    std::unique_ptr<render::FrameRenderer> renderer_;
    double samples_ = 0.0;
    std::size_t frames_ = 0;
    std::vector<std::vector<double>> frame_ms_;
    std::vector<std::vector<double>> frame_processor_ms_;
    std::vector<std::vector<double>> frame_elapsed_ms_;
    std::vector<std::vector<double>> frame_begin_ms_;
    std::array<double, frame::kMostPasses> pass_ms_{};
};

}  // namespace gazeloop::bench
