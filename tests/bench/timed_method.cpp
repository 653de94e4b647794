#include "tests/bench/timed_method.h"

#include <chrono>
#include <numeric>
#include <utility>

#include "tests/bench/bench.h"
#include "tests/bench/processor_time.h"

namespace gazeloop::bench {
namespace {

std::vector<double> medians(const std::vector<std::vector<double>>& rounds_of_frames) {
    std::vector<double> all;
    all.reserve(rounds_of_frames.size());
    for (const std::vector<double>& rounds : rounds_of_frames) {
        all.push_back(median(rounds));
    }
    return all;
}

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

TimedMethod::TimedMethod(const vulkan::Context& context, std::string name, scene::Scene& scene,
                         const render::MakePasses& passes, const render::RendererConfig& config,
                         std::size_t frames)
    : name_(std::move(name)),
      targets_(context, config.extents, config.format),
      renderer_(std::make_unique<render::FrameRenderer>(context, scene, passes, config)),
      frame_ms_(frames),
      frame_processor_ms_(frames),
      frame_elapsed_ms_(frames),
      frame_begin_ms_(frames) {}

void TimedMethod::warm_up(const vulkan::Context& context, const gaze::StereoView& views) {
    render::warm_up(context, *renderer_, views);
}

void TimedMethod::frame(std::size_t index, render::FrameView view, const gaze::FrameFovea& fovea) {
    view.targets = targets_.targets();
    const auto begin = std::chrono::steady_clock::now();
    const double begin_s = process_seconds();
    renderer_->wait_for_slot();
    const auto before_begin = std::chrono::steady_clock::now();
    renderer_->begin(view);
    const std::chrono::duration<double, std::milli> begun =
        std::chrono::steady_clock::now() - before_begin;
    frame_begin_ms_.at(index).push_back(begun.count());
    samples_ += static_cast<double>(renderer_->finish(fovea).shaded());
    ++frames_;
    renderer_->wait_idle();
    frame_processor_ms_.at(index).push_back(1e3 * (process_seconds() - begin_s));
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - begin;
    frame_elapsed_ms_.at(index).push_back(elapsed.count());
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

std::vector<double> TimedMethod::frame_ms() const { return medians(frame_ms_); }

double TimedMethod::ms() const { return mean(frame_ms()); }

double TimedMethod::processor_ms() const { return mean(medians(frame_processor_ms_)); }

std::vector<double> TimedMethod::frame_elapsed_ms() const { return medians(frame_elapsed_ms_); }

std::vector<double> TimedMethod::frame_begin_ms() const { return medians(frame_begin_ms_); }

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
