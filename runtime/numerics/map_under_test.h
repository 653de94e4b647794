#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "runtime/foveation/log_polar/acuity_map.h"
#include "runtime/foveation/log_polar/float_map.h"
#include "runtime/foveation/log_polar/map_error.h"
#include "runtime/foveation/plans/kfr_plan.h"
#include "runtime/numerics/map_probe.h"

namespace gazeloop::numerics {

/// What maps of one kind and LP size share, whatever the gaze: tables and the bounds of their
/// error.
struct MapFamily {
    foveation::MapTables tables;
    foveation::MapError error;
};

/// One map at one gaze: exact, as floats, and as the shaders' uniforms.
class MapUnderTest {
  public:
    MapUnderTest(std::shared_ptr<const MapFamily> family, const foveation::RadialKernel& kernel,
                 foveation::LpSize lp, foveation::ImageSize image,
                 const gaze::PixelPosition& fovea);
    MapUnderTest(std::shared_ptr<const MapFamily> family, const foveation::AcuityProfile& profile,
                 const gaze::EyeView& view, const gaze::PixelPosition& gaze_at);

    [[nodiscard]] const foveation::RadialMap& exact() const;
    [[nodiscard]] bool in_gaze_frame() const { return map_.index() == 1; }
    [[nodiscard]] foveation::LpSize lp() const { return plan_.lp; }
    [[nodiscard]] const gaze::PixelPosition& fovea() const { return fovea_; }

    /// The float mirror's answers.
    [[nodiscard]] std::vector<ProbeOutput> run(std::span<const ProbeInput> inputs) const;

    /// What the device needs to answer the same.
    [[nodiscard]] const foveation::MapTables& tables() const { return family_->tables; }
    [[nodiscard]] ProbeUniforms uniforms() const;

    /// ProbeOutput::place as a position of the picture; nothing: behind it.
    [[nodiscard]] std::optional<gaze::PixelPosition> placed(const glm::vec3& place) const;

    [[nodiscard]] double forward_bound_px(const gaze::PixelPosition& position) const;
    [[nodiscard]] double inverse_bound_px(const foveation::LpShare& centre) const;

  private:
    std::shared_ptr<const MapFamily> family_;
    std::variant<foveation::LogPolarMap, foveation::AcuityMap> map_;
    foveation::LogPolarPlan plan_;  ///< only what the uniforms are made of
    gaze::EyeView view_;
    gaze::PixelPosition fovea_;
};

}  // namespace gazeloop::numerics
