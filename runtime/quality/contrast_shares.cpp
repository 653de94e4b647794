#include "runtime/quality/contrast_shares.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <utility>
#include <vector>

#include "runtime/foveation/eye/resolution_limit.h"
#include "runtime/foveation/picture/gaze_field.h"
#include "runtime/quality/compared_pictures.h"
#include "runtime/quality/contrast_levels.h"
#include "runtime/quality/pyramid.h"

namespace gazeloop::quality {
namespace {

/// What contrasts are over is at least this, cd/m2; as the contrast metric has it.
constexpr float kLeastLuminance = 1e-3F;

/// The share of an octave around a band's frequency that lies below a cut-off.
double share_below(double log2_cutoff, double log2_band) {
    return std::clamp(log2_cutoff - log2_band + 0.5, 0.0, 1.0);
}

/// Squares of contrast, times solid angle.
struct Sums {
    double kept = 0.0;
    double between = 0.0;
    double beyond = 0.0;
};

class Shares {
  public:
    Shares(const foveation::GazeField& field, const foveation::MarLine& line)
        : ray_of_(field.frame().gaze_from_picture()), line_(line) {}

    /// One row of a band: its contrast is `whole` less `under`, over that.
    [[nodiscard]] Sums of_row(const ContrastLevels::Level& level, double step, std::uint32_t y,
                              const float* whole, const float* under) const {
        Sums sums;
        const float* const log2_cpd = level.log2_cpd.row(y);
        const float* const weight = level.weight.row(y);
        for (std::uint32_t x = 0; x < level.width; ++x) {
            const double contrast = static_cast<double>(whole[x] - under[x]) /
                                    static_cast<double>(std::max(under[x], kLeastLuminance)) /
                                    level.band_gain;
            const double energy = contrast * contrast * static_cast<double>(weight[x]);
            if (!(energy > 0.0)) {
                continue;
            }
            const glm::dvec3 ray = ray_of_ * glm::dvec3(x * step + 0.5, y * step + 0.5, 1.0);
            const double e_deg = glm::degrees(std::atan2(std::hypot(ray.x, ray.y), ray.z));
            const auto band = static_cast<double>(log2_cpd[x]);
            const double below_line = share_below(-std::log2(line_.omega_deg(e_deg)), band);
            const double below_limit =
                std::max(share_below(std::log2(limit_.cutoff_cpd(e_deg, 0.0)), band), below_line);
            sums.kept += below_line * energy;
            sums.between += (below_limit - below_line) * energy;
            sums.beyond += (1.0 - below_limit) * energy;
        }
        return sums;
    }

  private:
    glm::dmat3 ray_of_;
    foveation::MarLine line_;
    foveation::ResolutionLimit limit_;
};

}  // namespace

Expected<ContrastShares> contrast_shares(const render::LinearPicture& picture,
                                         const gaze::EyeView& view, const glm::dvec3& gaze,
                                         const foveation::MarLine& line, const DisplayLight& light,
                                         const RowWork& work) {
    if (auto checked = check_pictures(picture, picture, view); !checked) {
        return std::unexpected(checked.error());
    }
    if (auto checked = foveation::check_mar_line(line); !checked) {
        return std::unexpected(checked.error());
    }
    const auto field = foveation::GazeField::create(view, gaze);
    if (!field) {
        return std::unexpected(field.error());
    }
    // The eye tells where the nose is, which neither bound asks.
    const ContrastLevels levels(view, gaze::Eye::Left, work);
    const Shares shares(*field, line);
    std::array<Plane, kOpponentChannels> channels;
    opponent_planes(picture, light, work, channels);
    Plane whole = std::move(channels[kLuminance]);
    Plane coarser;
    Sums all;
    for (std::size_t at = 0; at < levels.bands(); ++at) {
        const ContrastLevels::Level& level = levels.levels()[at];
        reduce(whole, work, coarser);
        std::vector<Sums> rows(level.height);
        work.over(level.height, [&](std::uint32_t from, std::uint32_t to) {
            std::vector<float> scratch(coarser.width);
            std::vector<float> under(level.width);
            for (std::uint32_t y = from; y < to; ++y) {
                expand_row(coarser, y, level.width, scratch.data(), under.data());
                rows[y] = shares.of_row(level, std::ldexp(1.0, static_cast<int>(at)), y,
                                        whole.row(y), under.data());
            }
        });
        for (const Sums& row : rows) {
            all.kept += row.kept;
            all.between += row.between;
            all.beyond += row.beyond;
        }
        std::swap(whole, coarser);
    }
    const double sum = all.kept + all.between + all.beyond;
    if (!(sum > 0.0)) {
        return ContrastShares{};
    }
    return ContrastShares{.kept = all.kept / sum,
                          .between = all.between / sum,
                          .beyond = all.beyond / sum,
                          .contrast = std::sqrt(sum)};
}

}  // namespace gazeloop::quality
