#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "runtime/foveation/log_polar/radial_map.h"
#include "runtime/scene/scenes.h"
#include "tests/bench/bench.h"
#include "tests/support/rendered_method.h"

namespace gazeloop::bench {

/// The picture's content decides much of the speed-up: the middle of the first view is the scene's
/// dearest spot, a mirror. So frames are rendered in all four directions, as a head would turn.
inline constexpr std::array kYaws_deg{0.0, 90.0, 180.0, 270.0};

/// One eye's picture of the ray-marched scene, as the papers measure it: the other eye's picture is
/// the smallest that every method takes (8 x 8 px, under a ten thousandth of the work).
class RaycastSetup {
  public:
    /// half_width_rad: half of the horizontal field of view; the vertical one follows from square
    /// pixels.
    RaycastSetup(const vulkan::Context& context, vk::Extent2D extent, double half_width_rad);

    [[nodiscard]] const gaze::PerEye<vk::Extent2D>& extents() const { return extents_; }
    [[nodiscard]] std::string name() const;  ///< "1920x1080"
    /// Of a renderer for these pictures; 16 samples per cell unless the options say otherwise.
    [[nodiscard]] render::MethodConfig config(const Options& options) const;
    [[nodiscard]] vk::Extent2D extent() const { return extents_[0]; }

    /// The eye at the scene's origin, the head turned to the left by yaw_deg; the gaze falls on
    /// `fovea` of the measured picture and on the middle of the other.
    [[nodiscard]] render::FrameRequest frame(double yaw_deg,
                                             const gaze::PixelPosition& fovea) const;
    [[nodiscard]] gaze::PixelPosition centre() const;

  private:
    gaze::PerEye<vk::Extent2D> extents_;
    double half_width_rad_;
    gaze::PerEye<vulkan::ColorImage> images_;
};

/// One way to render, with the durations of its rounds.
class Contender {
  public:
    /// The ray-marched scene.
    Contender(const vulkan::Context& context, const render::MethodConfig& config);
    /// A scene that contenders share; it must outlive this.
    Contender(const vulkan::Context& context, const render::MethodConfig& config,
              scene::Scene& shared);

    /// Renders a frame and keeps what it took, unless it is the first of its kind, which compiles.
    void round(const render::FrameRequest& request, bool keep = true);
    /// Forgets the rounds.
    void reset();

    [[nodiscard]] double median_ms() const;
    /// Likewise, in processor time of this process (process_seconds()).
    [[nodiscard]] double median_processor_ms() const;
    /// Of that, the part before the gaze is read: what a scene draws for itself.
    [[nodiscard]] double median_before_gaze_processor_ms() const;
    /// 0 for a pass that the method does not have.
    [[nodiscard]] double median_ms(std::string_view pass) const;
    [[nodiscard]] const frame::PassList& passes() const { return renderer_->passes(); }
    /// Of the last round: cells that were shaded, of both eyes.
    [[nodiscard]] double cells() const;
    /// Of the last round, of the measured eye; of log-polar methods.
    [[nodiscard]] const foveation::LogPolarPlan& plan() const { return plan_; }

  private:
    render::MethodConfig config_;
    std::unique_ptr<scene::Scene> own_scene_;  ///< null: it shares one
    std::unique_ptr<render::FrameRenderer> renderer_;
    foveation::LogPolarPlan plan_;
    std::vector<double> total_ms_;
    std::vector<double> processor_ms_;
    std::vector<double> before_gaze_processor_ms_;
    std::array<std::vector<double>, frame::kMostPasses> pass_ms_;
    frame::SampleCounts counts_;
};

/// What a pixel costs at full resolution, cell by cell of a grid over the picture: content is
/// dearer in one place than in another, and a method that looks where it is dear can't be blamed
/// for it.
class CostMap {
  public:
    static constexpr std::uint32_t kCells = 6;  ///< a side

    /// Renders every cell of `whole` for itself at the picture's scale, so that their sum is one
    /// full frame; then scales them to sum up to `whole_ms`. Taken in processor time after the gaze
    /// is read, which a busy machine leaves alone. `scene` null: the ray-marched one.
    CostMap(const vulkan::Context& context, const RaycastSetup& setup, render::MethodConfig config,
            const render::FrameRequest& whole, double whole_ms, scene::Scene* scene = nullptr);

    /// What the plan's cells would take if each cost what a pixel at its place costs.
    [[nodiscard]] double predicted_ms(const foveation::LogPolarPlan& plan,
                                      const foveation::RadialMap& map) const;

  private:
    [[nodiscard]] double ms_at(const gaze::PixelPosition& position) const;

    vk::Extent2D extent_;
    std::array<double, std::size_t{kCells} * kCells> ms_per_pixel_{};
};

}  // namespace gazeloop::bench
