#include "tests/bench/raycast_setup.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "tests/bench/processor_time.h"

namespace gazeloop::bench {
namespace {

constexpr vk::Extent2D kOtherEye(8, 8);

/// An instant at which no exhibit hides another.
constexpr double kSceneTime_s = 2.5;

}  // namespace

RaycastSetup::RaycastSetup(const vulkan::Context& context, vk::Extent2D extent,
                           double half_width_rad)
    : extents_{extent, kOtherEye}, half_width_rad_(half_width_rad) {
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        images_[e] = vulkan::ColorImage(context, extents_[e], render::MethodConfig{}.format,
                                        vk::ImageUsageFlagBits::eColorAttachment);
    }
}

gaze::PixelPosition RaycastSetup::centre() const {
    return {extent().width / 2.0, extent().height / 2.0};
}

std::string RaycastSetup::name() const {
    return fmt::format("{}x{}", extent().width, extent().height);
}

render::MethodConfig RaycastSetup::config(const Options& options) const {
    render::MethodConfig config;
    config.samples = options.samples.value_or(16);
    config.extents = extents_;
    return config;
}

render::FrameRequest RaycastSetup::frame(double yaw_deg, const gaze::PixelPosition& fovea) const {
    render::FrameRequest request;
    request.scene_time_s = kSceneTime_s;
    const double half_height_rad =
        std::atan(std::tan(half_width_rad_) * extent().height / extent().width);
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        request.views[e] = {
            .pose = {.orientation = glm::angleAxis(yaw_deg * (std::numbers::pi / 180.0),
                                                   glm::dvec3(0.0, 1.0, 0.0))},
            .fov = {-half_width_rad_, half_width_rad_, half_height_rad, -half_height_rad},
            .width_px = extents_[e].width,
            .height_px = extents_[e].height};
        request.targets[e] = {images_[e].image(), images_[e].view()};
    }
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        request.gaze_directions[e] = gaze::unproject(fovea, request.views[0]);
    }
    request.foveae = {fovea, gaze::PixelPosition{kOtherEye.width / 2.0, kOtherEye.height / 2.0}};
    return request;
}

Contender::Contender(const vulkan::Context& context, const render::MethodConfig& config)
    : config_(config),
      own_scene_(scene::make_scene(context, "raymarch")),
      renderer_(std::make_unique<render::FrameRenderer>(context, *own_scene_,
                                                        render::passes_of(config), config)) {}

Contender::Contender(const vulkan::Context& context, const render::MethodConfig& config,
                     scene::Scene& shared)
    : config_(config),
      renderer_(std::make_unique<render::FrameRenderer>(context, shared, render::passes_of(config),
                                                        config)) {}

void Contender::round(const render::FrameRequest& request, bool keep) {
    const double begin_s = process_seconds();
    renderer_->wait_for_slot();
    renderer_->begin(request);
    renderer_->wait_for_begun();
    const double before_gaze_ms = 1e3 * (process_seconds() - begin_s);
    counts_ = renderer_->finish(request.fovea());
    renderer_->wait_idle();
    const double processor_ms = 1e3 * (process_seconds() - begin_s);
    const auto finished = renderer_->next_finished();
    plan_ = render::plan_of(config_, request, gaze::Eye::Left);
    if (!keep || !finished) {
        return;
    }
    double total = 0.0;
    for (std::size_t pass = 0; pass < frame::kMostPasses; ++pass) {
        if (const auto ns = finished->passes[pass]) {
            const double ms = static_cast<double>(*ns) * 1e-6;
            pass_ms_[pass].push_back(ms);
            total += ms;
        }
    }
    total_ms_.push_back(total);
    processor_ms_.push_back(processor_ms);
    before_gaze_processor_ms_.push_back(before_gaze_ms);
}

void Contender::reset() {
    total_ms_.clear();
    processor_ms_.clear();
    before_gaze_processor_ms_.clear();
    for (auto& pass : pass_ms_) {
        pass.clear();
    }
}

double Contender::median_ms() const { return median(total_ms_); }

double Contender::median_processor_ms() const { return median(processor_ms_); }

double Contender::median_before_gaze_processor_ms() const {
    return median(before_gaze_processor_ms_);
}

double Contender::median_ms(std::string_view pass) const {
    const auto at = renderer_->passes().find(pass);
    return !at || pass_ms_[*at].empty() ? 0.0 : median(pass_ms_[*at]);
}

double Contender::cells() const { return static_cast<double>(counts_.shaded()); }

CostMap::CostMap(const vulkan::Context& context, const RaycastSetup& setup,
                 render::MethodConfig config, const render::FrameRequest& whole_picture,
                 double whole_ms, scene::Scene* scene)
    : extent_(setup.extent()) {
    const vk::Extent2D cell(extent_.width / kCells, extent_.height / kCells);
    config.method = render::Method::Full;
    config.extents = {cell, setup.extents()[1]};
    const vulkan::ColorImage image(context, cell, config.format,
                                   vk::ImageUsageFlagBits::eColorAttachment);
    Contender full =
        scene != nullptr ? Contender(context, config, *scene) : Contender(context, config);
    render::FrameRequest request = whole_picture;
    const gaze::FieldOfView whole = request.views[0].fov;
    request.views[0].width_px = cell.width;
    request.views[0].height_px = cell.height;
    request.targets[0] = {image.image(), image.view()};
    const auto between = [](double from_rad, double to_rad, double share) {
        return std::atan(std::lerp(std::tan(from_rad), std::tan(to_rad), share));
    };
    double sum_ms = 0.0;
    full.round(request, false);
    for (std::uint32_t row = 0; row < kCells; ++row) {
        for (std::uint32_t column = 0; column < kCells; ++column) {
            const double step = 1.0 / kCells;
            request.views[0].fov = {between(whole.left_rad, whole.right_rad, column * step),
                                    between(whole.left_rad, whole.right_rad, (column + 1) * step),
                                    between(whole.up_rad, whole.down_rad, row * step),
                                    between(whole.up_rad, whole.down_rad, (row + 1) * step)};
            full.reset();
            full.round(request);
            const double ms = full.median_processor_ms() - full.median_before_gaze_processor_ms();
            ms_per_pixel_[std::size_t{row} * kCells + column] = ms;
            sum_ms += ms;
        }
    }
    const double scale =
        whole_ms / sum_ms /
        (static_cast<double>(extent_.width) * extent_.height / (double{kCells} * kCells));
    for (double& cost : ms_per_pixel_) {
        cost *= scale;
    }
}

double CostMap::ms_at(const gaze::PixelPosition& position) const {
    const auto index = [](double share) {
        return static_cast<std::size_t>(std::clamp(share * kCells, 0.0, kCells - 1.0));
    };
    return ms_per_pixel_[index(position.y_px / extent_.height) * kCells +
                         index(position.x_px / extent_.width)];
}

double CostMap::predicted_ms(const foveation::LogPolarPlan& plan,
                             const foveation::RadialMap& map) const {
    double sum_ms = 0.0;
    const auto add = [&](const std::vector<foveation::Columns>& bands, std::uint32_t height,
                         const auto& position) {
        for (std::uint32_t y = 0; y < height && y / foveation::kBandRows < bands.size(); ++y) {
            const foveation::Columns& columns = bands[y / foveation::kBandRows];
            for (std::uint32_t x = columns.first; x < columns.end; ++x) {
                sum_ms += ms_at(position(x, y));
            }
        }
    };
    add(plan.texels.bands, plan.lp.height, [&](std::uint32_t x, std::uint32_t y) {
        return map.position({(x + 0.5) / plan.lp.width, (y + 0.5) / plan.lp.height})
            .value_or(gaze::PixelPosition{});
    });
    add(plan.disc.bands, extent_.height,
        [](std::uint32_t x, std::uint32_t y) { return gaze::PixelPosition{x + 0.5, y + 0.5}; });
    return sum_ms;
}

}  // namespace gazeloop::bench
