#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "runtime/frame/frame_observer.h"
#include "runtime/governor/governor.h"
#include "runtime/governor/governor_settings.h"
#include "runtime/render/frame_chooser.h"
#include "runtime/render/frame_renderer.h"
#include "runtime/render/run_lists.h"

namespace gazeloop::run {

/// Has each frame drawn by the level that a governor decides, or, in the replay of a session, by
/// the one that was recorded. Follows what frames took on the GPU and what the eyes did. Each level
/// has a renderer of its own, so that a change makes nothing anew.
class GovernedFrames final : public render::FrameChooser, public frame::FrameObserver {
  public:
    /// `replay`: levels are the recorded ones, and nothing is decided.
    GovernedFrames(const governor::GovernorSettings& settings,
                   const governor::GovernorOptions& options, std::size_t levels, bool replay);

    /// Before the first frame; one for each level. `ms`: what a frame takes by each, here.
    /// Throws SetupError: as render::RunLists::add().
    void set_renderers(std::vector<std::unique_ptr<render::FrameRenderer>> renderers,
                       std::span<const double> ms);

    render::FrameRenderer* choose(const render::FrameToChoose& frame) override;
    [[nodiscard]] gaze::FrameFovea drawn(const gaze::FrameFovea& latched,
                                         const gaze::StereoView& /*views*/) const override {
        return latched;
    }
    [[nodiscard]] std::optional<std::uint8_t> quality_level() const override { return level_; }
    [[nodiscard]] std::optional<render::ChooserEvent> take_event() override;
    [[nodiscard]] const frame::PassList& passes() const override { return lists_.passes(); }
    [[nodiscard]] const frame::GridList& grids() const override { return lists_.grids(); }
    [[nodiscard]] frame::SampleCounts in_run(const render::FrameRenderer& renderer,
                                             const frame::SampleCounts& counts) const override {
        return lists_.in_run(renderer, counts);
    }
    [[nodiscard]] frame::FrameGpuRecord in_run(const render::FrameRenderer& renderer,
                                               const frame::FrameGpuRecord& record) const override {
        return lists_.in_run(renderer, record);
    }
    void release() override { renderers_.clear(); }

    void on_frame(const frame::FrameRecord& record) override;
    void on_gpu(const frame::FrameGpuRecord& record) override;

  private:
    [[nodiscard]] std::size_t recorded_level(const render::FrameToChoose& frame) const;

    static constexpr std::size_t kUnderWay = 16;  ///< more than frames can be on the GPU

    governor::GovernorSettings settings_;
    governor::GovernorOptions options_;
    std::size_t levels_;
    bool replay_;
    std::optional<governor::Governor> governor_;
    std::optional<governor::Decision> decision_;  ///< not told yet
    std::vector<std::unique_ptr<render::FrameRenderer>> renderers_;
    render::RunLists lists_{"the governor's levels"};
    std::optional<std::uint8_t> level_;
    governor::SeenEyes eyes_;
    std::array<std::size_t, kUnderWay> level_of_{};  ///< of the frames with these last digits
};

}  // namespace gazeloop::run
