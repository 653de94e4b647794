#include "runtime/numerics/map_under_test.h"

#include <cmath>

namespace gazeloop::numerics {
namespace {

using foveation::AcuityMap;
using foveation::LogPolarMap;

/// In the picture's frame no field of view matters.
gaze::EyeView any_view(foveation::ImageSize image) {
    return {
        .fov = {-0.8, 0.8, 0.8, -0.8}, .width_px = image.width_px, .height_px = image.height_px};
}

}  // namespace

MapUnderTest::MapUnderTest(std::shared_ptr<const MapFamily> family,
                           const foveation::RadialKernel& kernel, foveation::LpSize lp,
                           foveation::ImageSize image, const gaze::PixelPosition& fovea)
    : family_(std::move(family)),
      map_(LogPolarMap(kernel, image, fovea)),
      view_(any_view(image)),
      fovea_(fovea) {
    plan_.lp = lp;
    plan_.fovea = fovea;
    plan_.log2_max_radius = std::get<LogPolarMap>(map_).log2_max_radius();
}

MapUnderTest::MapUnderTest(std::shared_ptr<const MapFamily> family,
                           const foveation::AcuityProfile& profile, const gaze::EyeView& view,
                           const gaze::PixelPosition& gaze_at)
    : family_(std::move(family)),
      map_(AcuityMap(profile, foveation::GazeFrame(view, gaze::unproject(gaze_at, view)))),
      view_(view),
      fovea_(gaze_at) {
    plan_.lp = profile.lp();
    foveation::LogPolarPlan::InGazeFrame in_gaze_frame;
    in_gaze_frame.uniforms = foveation::gaze_frame_uniforms(std::get<AcuityMap>(map_).frame());
    plan_.in_gaze_frame = in_gaze_frame;
}

const foveation::RadialMap& MapUnderTest::exact() const {
    return std::visit([](const auto& map) -> const foveation::RadialMap& { return map; }, map_);
}

std::vector<ProbeOutput> MapUnderTest::run(std::span<const ProbeInput> inputs) const {
    const foveation::FloatMap mirror =
        in_gaze_frame() ? foveation::FloatMap(tables(), lp(), plan_.in_gaze_frame->uniforms)
                        : foveation::FloatMap(tables(), lp(),
                                              foveation::picture_frame_uniforms(
                                                  plan_.fovea, plan_.log2_max_radius));
    std::vector<ProbeOutput> outputs;
    outputs.reserve(inputs.size());
    for (const ProbeInput& input : inputs) {
        const auto share = mirror.share(input.position_px);
        const auto column = static_cast<std::uint32_t>(input.cell.x);
        const auto row = static_cast<std::uint32_t>(input.cell.y);
        outputs.push_back({.share = {share.u, share.v},
                           .place = in_gaze_frame() ? mirror.view_ray(column, row)
                                                    : glm::vec3(mirror.position(column, row), 0)});
    }
    return outputs;
}

ProbeUniforms MapUnderTest::uniforms() const {
    return {render::frame_uniforms(view_, 0.0, 1, nullptr), foveation::map_uniforms(plan_)};
}

std::optional<gaze::PixelPosition> MapUnderTest::placed(const glm::vec3& place) const {
    if (!in_gaze_frame()) {
        return gaze::PixelPosition{place.x, place.y};
    }
    const glm::dvec3 ray(place);
    if (!(ray.z < 0.0)) {
        return std::nullopt;
    }
    const double left = std::tan(view_.fov.left_rad);
    const double up = std::tan(view_.fov.up_rad);
    return gaze::PixelPosition{
        (ray.x / -ray.z - left) * view_.width_px / (std::tan(view_.fov.right_rad) - left),
        (ray.y / -ray.z - up) * view_.height_px / (std::tan(view_.fov.down_rad) - up)};
}

double MapUnderTest::forward_bound_px(const gaze::PixelPosition& position) const {
    return std::visit([&](const auto& map) { return family_->error.forward_px(map, position); },
                      map_);
}

double MapUnderTest::inverse_bound_px(const foveation::LpShare& centre) const {
    return std::visit([&](const auto& map) { return foveation::MapError::inverse_px(map, centre); },
                      map_);
}

}  // namespace gazeloop::numerics
