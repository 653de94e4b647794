#include "runtime/present/headless_target.h"

#include <fmt/core.h>

#include <algorithm>

#include "runtime/time/clock.h"

namespace gazeloop::present {

HeadlessTarget::HeadlessTarget(const Options& options) : options_(options) {}

void HeadlessTarget::start(const vulkan::Context& context) {
    for (const gaze::Eye eye : gaze::kEyes) {
        images_[gaze::index(eye)] = vulkan::ColorImage(
            context, options_.extents[gaze::index(eye)], options_.format,
            vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc);
    }
    first_emission_ns_ = time::monotonic_ns();
}

gaze::PerEye<vk::Extent2D> HeadlessTarget::extents() const { return options_.extents; }
vk::Format HeadlessTarget::format() const { return options_.format; }

void HeadlessTarget::wait_frame(TargetFrame& frame) {
    const std::int64_t period = options_.display.period_ns();
    frame.period_ns = period;
    if (options_.paced) {
        // The emission after the last announced one. If that is too close, the first one that
        // leaves one period for the work. The loop wakes one period before it.
        const std::int64_t since = time::monotonic_ns() - first_emission_ns_;
        const std::int64_t first_in_time = (since + period - 1) / period + 1;
        next_emission_ = std::max(next_emission_ + 1, first_in_time);
        time::sleep_until_ns(first_emission_ns_ + (next_emission_ - 1) * period);
    } else {
        ++next_emission_;
    }
    frame.display = {first_emission_ns_ + next_emission_ * period, time::StampKind::Predicted};
    frame.aimed_ns = frame.display.ns;
    frame.should_render = true;
}

void HeadlessTarget::locate(TargetFrame& frame) {
    frame.head = {};
    for (const gaze::Eye eye : gaze::kEyes) {
        const std::size_t e = gaze::index(eye);
        frame.views[e] = display::profile_view(options_.display, eye, options_.extents[e].width,
                                               options_.extents[e].height);
    }
}

gaze::PerEye<render::EyeTarget> HeadlessTarget::acquire() {
    return {render::EyeTarget{images_[0].image(), images_[0].view()},
            render::EyeTarget{images_[1].image(), images_[1].view()}};
}

std::vector<std::pair<std::string, std::string>> HeadlessTarget::properties() const {
    return {{"target", "headless"},
            {"display", options_.display.name},
            {"target format", vk::to_string(options_.format)}};
}

}  // namespace gazeloop::present
