#pragma once

#include <optional>

#include "runtime/render/frame_renderer.h"
#include "runtime/render/picture.h"

namespace gazeloop::render {

/// Images of the pictures' sizes and format, and depth images if a depth format is given: targets
/// that no display shows.
class OffScreenTargets {
  public:
    OffScreenTargets() = default;
    /// `depth_format` undefined: without depth.
    OffScreenTargets(const vulkan::Context& context, const gaze::PerEye<vk::Extent2D>& extents,
                     vk::Format format, vk::Format depth_format = vk::Format::eUndefined);

    [[nodiscard]] gaze::PerEye<EyeTarget> targets() const;
    [[nodiscard]] const vulkan::ColorImage& color(gaze::Eye eye) const {
        return color_[gaze::index(eye)];
    }
    [[nodiscard]] const vulkan::DepthImage& depth(gaze::Eye eye) const {
        return depth_[gaze::index(eye)];
    }

  private:
    gaze::PerEye<vulkan::ColorImage> color_;
    gaze::PerEye<vulkan::DepthImage> depth_;
    bool has_depth_ = false;
};

/// Renders single frames off screen, each finished before the next.
class OffScreen {
  public:
    /// As FrameRenderer's.
    OffScreen(const vulkan::Context& context, scene::Scene& scene, const MakePasses& make_passes,
              const RendererConfig& config);

    struct Rendered {
        frame::SampleCounts counts;
        frame::FrameGpuRecord gpu;
    };
    /// The view's targets are ignored.
    Rendered render(FrameView view, const gaze::FrameFovea& fovea);

    /// Of the frame that was rendered last.
    [[nodiscard]] Picture picture(gaze::Eye eye) const;
    [[nodiscard]] LinearPicture linear_picture(gaze::Eye eye) const;
    /// Precondition: the configuration has a depth format.
    [[nodiscard]] std::vector<float> depth(gaze::Eye eye) const;

    [[nodiscard]] FrameRenderer& renderer() { return renderer_; }
    [[nodiscard]] const FrameRenderer& renderer() const { return renderer_; }

  private:
    const vulkan::Context* context_;
    OffScreenTargets targets_;
    FrameRenderer renderer_;  ///< waits for its frames before the images go
};

/// Renders a frame that nobody sees, the gaze straight ahead, and waits for it. Precondition: the
/// renderer has no frame under way.
frame::FrameGpuRecord render_unseen(const vulkan::Context& context, FrameRenderer& renderer,
                                    const gaze::StereoView& views);

/// Renders a frame that nobody sees, so that the renderer's first frame that counts finds its
/// shaders compiled. Precondition: the renderer has rendered nothing yet.
void warm_up(const vulkan::Context& context, FrameRenderer& renderer,
             const gaze::StereoView& views);

/// A gaze straight ahead, in both eyes, as a fovea of these views.
[[nodiscard]] gaze::FrameFovea fovea_ahead(const gaze::StereoView& views);

}  // namespace gazeloop::render
