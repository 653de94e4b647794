#include "runtime/render/log_polar_eye.h"

#include "runtime/error.h"
#include "runtime/foveation/log_polar/map_tables.h"
#include "runtime/foveation/plans/acuity_plan.h"

namespace gazeloop::render {

LogPolarEye::LogPolarEye(const vulkan::Context& context, Map map, foveation::LpSize lp,
                         foveation::ImageSize image, const foveation::MapTables& tables)
    : map_(std::move(map)),
      image_(image),
      lp_(lp),
      lp_buffer_(context, vk::Extent2D(lp.width, lp.height), kLpFormat,
                 vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eSampled |
                     vk::ImageUsageFlagBits::eTransferSrc),
      direct_buffer_(context, vk::Extent2D(image.width_px, image.height_px), kLpFormat,
                     vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eSampled |
                         vk::ImageUsageFlagBits::eTransferSrc),
      map_buffers_(context, tables) {}

LogPolarEye::LogPolarEye(const vulkan::Context& context, const foveation::KfrParameters& parameters,
                         foveation::ImageSize image)
    : LogPolarEye(
          context, parameters, value_or_throw(foveation::lp_buffer_size(parameters, image)), image,
          foveation::build_map_tables(
              parameters.kernel, value_or_throw(foveation::lp_buffer_size(parameters, image)))) {}

LogPolarEye::LogPolarEye(const vulkan::Context& context, Acuity acuity, foveation::ImageSize image)
    : LogPolarEye(context, acuity, acuity.profile.lp(), image,
                  foveation::build_map_tables(acuity.profile)) {}

LogPolarEye::LogPolarEye(const vulkan::Context& context,
                         const foveation::AcuityParameters& parameters, const gaze::EyeView& view)
    : LogPolarEye(
          context,
          Acuity{.parameters = parameters,
                 .profile = value_or_throw(foveation::AcuityProfile::create(parameters, view)),
                 .fov = view.fov},
          {view.width_px, view.height_px}) {}

bool LogPolarEye::fits(const gaze::EyeView& view) const {
    const Acuity* const acuity = std::get_if<Acuity>(&map_);
    return acuity == nullptr || acuity->fov == view.fov;
}

void LogPolarEye::plan(const gaze::EyeView& view, const gaze::PixelPosition& fovea,
                       const glm::dvec3& direction, const foveation::HiddenArea* hidden,
                       foveation::SamplingPlan& plan) const {
    if (const Acuity* const acuity = std::get_if<Acuity>(&map_)) {
        foveation::plan_acuity(acuity->parameters, acuity->profile, view, direction, plan, hidden);
    } else {
        foveation::plan_kfr(std::get<foveation::KfrParameters>(map_), lp_, image_, fovea, plan,
                            hidden);
    }
}

std::size_t LogPolarEye::max_bands() const {
    return std::size_t{lp_.height / foveation::kBandRows} +
           image_.height_px / foveation::kBandRows + 2;
}

}  // namespace gazeloop::render
