#pragma once

#include <variant>

#include "runtime/foveation/log_polar/acuity_profile.h"
#include "runtime/foveation/picture/image_size.h"
#include "runtime/foveation/plans/sampling_plan.h"
#include "runtime/render/map_buffers.h"
#include "runtime/vulkan/memory.h"

namespace gazeloop::render {

/// Format of LP-buffer and disc: linear light, filterable.
inline constexpr vk::Format kLpFormat = vk::Format::eR16G16B16A16Sfloat;

/// What one eye's log-polar rendering keeps on the GPU from frame to frame: the map's tables, which
/// no gaze changes, the LP-buffer, and a picture-sized buffer for the disc's pixels.
class LogPolarEye {
  public:
    /// Kernel foveated rendering. Throws SetupError (Usage) as lp_buffer_size reports.
    LogPolarEye(const vulkan::Context& context, const foveation::KfrParameters& parameters,
                foveation::ImageSize image);
    /// The acuity-derived map of this view. Throws SetupError (Usage) as AcuityProfile::create
    /// reports.
    LogPolarEye(const vulkan::Context& context, const foveation::AcuityParameters& parameters,
                const gaze::EyeView& view);

    /// Whether it can render a view: the acuity-derived map is made for one field of view.
    [[nodiscard]] bool fits(const gaze::EyeView& view) const;

    /// Plans a frame. `direction`, in the view frame, is read by the acuity-derived map, `fovea`
    /// by the kernel's. Reuses the plan's memory.
    void plan(const gaze::EyeView& view, const gaze::PixelPosition& fovea,
              const glm::dvec3& direction, const foveation::HiddenArea* hidden,
              foveation::SamplingPlan& plan) const;

    [[nodiscard]] foveation::LpSize lp() const { return lp_; }
    [[nodiscard]] foveation::ImageSize image() const { return image_; }
    [[nodiscard]] const vulkan::ColorImage& lp_buffer() const { return lp_buffer_; }
    /// Pixels of the picture that are shaded directly; only those of the plan's disc are written.
    [[nodiscard]] const vulkan::ColorImage& direct_buffer() const { return direct_buffer_; }
    [[nodiscard]] const MapBuffers& map_buffers() const { return map_buffers_; }

    /// Most bands that a plan of this eye can have.
    [[nodiscard]] std::size_t max_bands() const;

  private:
    struct Acuity {
        foveation::AcuityParameters parameters;
        foveation::AcuityProfile profile;
        gaze::FieldOfView fov;
    };
    using Map = std::variant<foveation::KfrParameters, Acuity>;

    LogPolarEye(const vulkan::Context& context, Map map, foveation::LpSize lp,
                foveation::ImageSize image, const foveation::MapTables& tables);
    LogPolarEye(const vulkan::Context& context, Acuity acuity, foveation::ImageSize image);

    Map map_;
    foveation::ImageSize image_;
    foveation::LpSize lp_;
    vulkan::ColorImage lp_buffer_;
    vulkan::ColorImage direct_buffer_;
    MapBuffers map_buffers_;
};

}  // namespace gazeloop::render
