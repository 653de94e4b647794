#include "tests/bench/timed_method.h"

#include <numeric>
#include <utility>

#include "tests/bench/bench.h"

namespace gazeloop::bench {

TimedMethod::TimedMethod(const vulkan::Context& context, std::string name, scene::Scene& scene,
                         const render::MakePasses& passes, const render::RendererConfig& config,
                         std::size_t frames)
    : name_(std::move(name)),
      targets_(context, config.extents, config.format),
      renderer_(std::make_unique<render::FrameRenderer>(context, scene, passes, config)),
      frame_ms_(frames) {}

void TimedMethod::warm_up(const vulkan::Context& context, const gaze::StereoView& views) {
    render::warm_up(context, *renderer_, views);
}

void TimedMethod::frame(std::size_t index, render::FrameView view, const gaze::FrameFovea& fovea) {
    view.targets = targets_.targets();
    renderer_->wait_for_slot();
    renderer_->begin(view);
    samples_ += static_cast<double>(renderer_->finish(fovea).shaded());
    ++frames_;
    renderer_->wait_idle();
    while (const auto finished = renderer_->next_finished()) {
        double total_ms = 0.0;
        for (std::size_t pass = 0; pass < renderer_->passes().size(); ++pass) {
            const double ms = static_cast<double>(finished->passes[pass].value_or(0)) * 1e-6;
            pass_ms_.at(pass) += ms;
            total_ms += ms;
        }
        frame_ms_.at(index).push_back(total_ms);
    }
}

std::vector<double> TimedMethod::frame_ms() const {
    std::vector<double> medians;
    for (const std::vector<double>& rounds : frame_ms_) {
        medians.push_back(median(rounds));
    }
    return medians;
}

double TimedMethod::ms() const {
    const std::vector<double> all = frame_ms();
    return std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
}

double TimedMethod::pass_ms(std::string_view pass) const {
    const auto at = renderer_->passes().find(pass);
    return at ? pass_ms(*at) : 0.0;
}

render::LinearPicture TimedMethod::picture(const vulkan::Context& context, gaze::Eye eye) const {
    const vulkan::ColorImage& image = targets_.color(eye);
    return render::read_back_linear(context, image.image(), image.extent(), image.format(),
                                    vk::ImageLayout::eColorAttachmentOptimal);
}

}  // namespace gazeloop::bench
