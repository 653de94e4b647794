#include "runtime/render/off_screen.h"

namespace gazeloop::render {

OffScreenTargets::OffScreenTargets(const vulkan::Context& context,
                                   const gaze::PerEye<vk::Extent2D>& extents, vk::Format format,
                                   vk::Format depth_format)
    : has_depth_(depth_format != vk::Format::eUndefined) {
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        color_[e] = vulkan::ColorImage(
            context, extents[e], format,
            vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc);
        if (has_depth_) {
            depth_[e] = vulkan::DepthImage(context, extents[e], depth_format);
        }
    }
}

gaze::PerEye<EyeTarget> OffScreenTargets::targets() const {
    gaze::PerEye<EyeTarget> targets{};
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        targets[e] = {color_[e].image(), color_[e].view()};
        if (has_depth_) {
            targets[e].depth_image = depth_[e].image();
            targets[e].depth_view = depth_[e].view();
        }
    }
    return targets;
}

OffScreen::OffScreen(const vulkan::Context& context, scene::Scene& scene,
                     const MakePasses& make_passes, const RendererConfig& config)
    : context_(&context),
      targets_(context, config.extents, config.format, config.depth_format),
      renderer_(context, scene, make_passes, config) {}

OffScreen::Rendered OffScreen::render(FrameView view, const gaze::FrameFovea& fovea) {
    view.targets = targets_.targets();
    Rendered rendered;
    renderer_.wait_for_slot();
    renderer_.begin(view);
    rendered.counts = renderer_.finish(fovea);
    renderer_.wait_idle();
    while (auto finished = renderer_.next_finished()) {
        rendered.gpu = *finished;
    }
    return rendered;
}

Picture OffScreen::picture(gaze::Eye eye) const {
    const vulkan::ColorImage& image = targets_.color(eye);
    return read_back(*context_, image.image(), image.extent(), image.format(),
                     vk::ImageLayout::eColorAttachmentOptimal);
}

LinearPicture OffScreen::linear_picture(gaze::Eye eye) const {
    const vulkan::ColorImage& image = targets_.color(eye);
    return read_back_linear(*context_, image.image(), image.extent(), image.format(),
                            vk::ImageLayout::eColorAttachmentOptimal);
}

std::vector<float> OffScreen::depth(gaze::Eye eye) const {
    return read_back_depth(*context_, targets_.depth(eye));
}

frame::FrameGpuRecord render_unseen(const vulkan::Context& context, FrameRenderer& renderer,
                                    const gaze::StereoView& views) {
    const RendererConfig& config = renderer.config();
    const OffScreenTargets targets(context, config.extents, config.format, config.depth_format);
    const FrameView view{.views = views, .targets = targets.targets()};
    renderer.wait_for_slot();
    renderer.begin(view);
    renderer.finish(fovea_ahead(views));
    renderer.wait_idle();
    frame::FrameGpuRecord last;
    while (auto finished = renderer.next_finished()) {
        last = *finished;
    }
    return last;
}

void warm_up(const vulkan::Context& context, FrameRenderer& renderer,
             const gaze::StereoView& views) {
    render_unseen(context, renderer, views);
}

gaze::FrameFovea fovea_ahead(const gaze::StereoView& views) {
    gaze::FrameFovea fovea;
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        fovea.eyes[e].direction = {0.0, 0.0, -1.0};
        fovea.eyes[e].position = gaze::project(fovea.eyes[e].direction, views[e]);
    }
    return fovea;
}

}  // namespace gazeloop::render
