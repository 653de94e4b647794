#pragma once

#include <functional>

#include "runtime/display/display_profile.h"
#include "runtime/present/frame_target.h"
#include "runtime/vulkan/memory.h"

namespace gazeloop::present {

/// Pictures into images that nobody sees, at the rate of a display that does not exist. Its
/// "emissions" lie at multiples of the profile's period from start(). A frame is announced for the
/// first emission that is at least a period ahead. Without pacing (virtual time, benchmarks) it
/// never waits and announces one emission after the other.
class HeadlessTarget final : public FrameTarget {
  public:
    struct Options {
        display::DisplayProfile display;
        gaze::PerEye<vk::Extent2D> extents;
        vk::Format format = vk::Format::eR8G8B8A8Srgb;
        bool paced = true;
    };
    explicit HeadlessTarget(const Options& options);

    vulkan::Factory* vulkan_factory() override { return nullptr; }
    void start(const vulkan::Context& context) override;
    [[nodiscard]] gaze::PerEye<vk::Extent2D> extents() const override;
    [[nodiscard]] vk::Format format() const override;
    TargetState poll() override {
        return exit_requested_ ? TargetState::Ended : TargetState::Running;
    }
    void wait_frame(TargetFrame& frame) override;
    void begin_frame() override {}
    void locate(TargetFrame& frame) override;
    gaze::PerEye<render::EyeTarget> acquire() override;
    void end_frame(const TargetFrame&, bool) override {}
    std::optional<gaze::Pose> head_at(std::int64_t) override { return gaze::Pose{}; }
    void request_exit() override { exit_requested_ = true; }
    [[nodiscard]] std::vector<std::pair<std::string, std::string>> properties() const override;
    std::vector<frame::Event> take_events() override { return {}; }

  private:
    Options options_;
    gaze::PerEye<vulkan::ColorImage> images_;
    std::int64_t first_emission_ns_ = 0;
    std::int64_t next_emission_ = 0;
    bool exit_requested_ = false;
};

}  // namespace gazeloop::present
