#include "runtime/foveation/plans/eccentricity_layers.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "runtime/foveation/eye/guenter_acuity.h"

namespace gazeloop::foveation {
namespace {

/// Tangents of half the field of view. The range has room for every real flat display: .01 to 179.9
/// degrees.
constexpr double kMinHalfWidth = 1e-4;
constexpr double kMaxHalfWidth = 1200.0;
constexpr double kMaxWidthPx = 1e7;
constexpr double kMaxAspect = 1e5;

Expected<void> check(std::string_view what, double value, double least, double greatest) {
    if (!(value >= least && value <= greatest)) {  // true for NaN
        return std::unexpected(Error{
            ErrorKind::Usage,
            fmt::format("layers: {} = {}: must lie in [{}, {}]", what, value, least, greatest)});
    }
    return {};
}

Expected<void> check(const LayerDisplay& display, const MarLine& line,
                     const LayerOptions& options) {
    if (auto checked = check_mar_line(line); !checked) {
        return checked;
    }
    const auto& [layers, weights, second_factor] = options;
    for (const auto& checked :
         {check("half_width_tangent", display.half_width_tangent, kMinHalfWidth, kMaxHalfWidth),
          check("width_px", display.width_px, 2.0, kMaxWidthPx),
          check("aspect", display.aspect, 1.0 / kMaxAspect, kMaxAspect),
          check("number of layers", layers, second_factor != 0.0 ? 3 : 1,
                LayerOptions::kMaxLayers)}) {
        if (!checked) {
            return checked;
        }
    }
    if (!weights.empty() && weights.size() != static_cast<std::size_t>(layers)) {
        return std::unexpected(
            Error{ErrorKind::Usage, fmt::format("layers: {} weights for {} layers: there must be "
                                                "one each, or none",
                                                weights.size(), layers)});
    }
    for (const double weight : weights) {
        if (auto checked = check("weight", weight, 1e-6, 1e6); !checked) {
            return checked;
        }
    }
    return second_factor == 0.0 ? Expected<void>{}
                                : check("second_factor", second_factor, 1.0, 1e3);
}

/// A choice of the boundaries between layers, and its work.
struct Choice {
    std::vector<double> boundaries_deg;
    double work = std::numeric_limits<double>::infinity();
};

class Problem {
  public:
    Problem(const LayerDisplay& display, const MarLine& line, const LayerOptions& options)
        : display_(display), line_(line), options_(options) {}

    /// s of a layer, given the boundary inside it.
    [[nodiscard]] double factor(std::size_t layer, double inner_deg) const {
        if (layer == 0) {
            return 1.0;
        }
        if (layer == 1 && options_.second_factor > 0.0) {
            return options_.second_factor;
        }
        return std::max(1.0, line_.omega_deg(inner_deg) / display_.sharpness_deg());
    }

    /// D of a layer that ends at `outer_deg` inside the display.
    [[nodiscard]] double width_px(double factor, double outer_deg) const {
        return display_.width_px / factor * std::tan(glm::radians(outer_deg)) /
               display_.half_width_tangent;
    }

    [[nodiscard]] double display_pixels() const {
        return display_.aspect * display_.width_px * display_.width_px;
    }

    [[nodiscard]] double weight(std::size_t layer) const {
        return options_.weights.empty() ? 1.0 : options_.weights[layer];
    }

    /// The least work with this many layers; none if the fixed factor leaves no room for them.
    [[nodiscard]] std::optional<Choice> solve(std::size_t layers) const {
        const double radius = display_.radius_deg();
        if (layers == 1) {
            return Choice{{}, weight(0) * display_pixels()};
        }
        std::vector<std::vector<double>> candidates(layers - 1, first_grid(radius));
        if (options_.second_factor > 0.0) {
            // Exactly where the line allows that factor.
            const double first =
                (options_.second_factor * display_.sharpness_deg() - line_.omega0_deg) /
                line_.slope;
            if (first >= radius) {
                return std::nullopt;
            }
            candidates[0] = {std::max(first, 0.0)};
        }
        Choice best = best_of(candidates);
        constexpr int kHalf = 8;        // grid points on each side of the best so far
        constexpr double kFiner = 4.0;  // each grid reaches two steps of the one before
        double step = radius / kFirstSteps;
        while (step > 1e-12 * radius) {
            for (std::size_t i = 0; i < candidates.size(); ++i) {
                if (candidates[i].size() == 1) {
                    continue;
                }
                candidates[i].clear();
                for (int k = -kHalf; k <= kHalf; ++k) {
                    candidates[i].push_back(
                        std::clamp(best.boundaries_deg[i] + k * step / kFiner, 0.0, radius));
                }
            }
            Choice refined = best_of(candidates);
            if (refined.work < best.work) {
                best = std::move(refined);
            }
            step /= kFiner;
        }
        return best;
    }

  private:
    static constexpr int kFirstSteps = 200;

    /// Even steps, and finer ones towards the gaze, where wide displays have their first layers.
    static std::vector<double> first_grid(double radius) {
        std::vector<double> grid;
        for (int i = 0; i < kFirstSteps; ++i) {
            const double share = static_cast<double>(i) / kFirstSteps;
            grid.push_back(radius * share);
            grid.push_back(radius * share * share * share);
        }
        std::ranges::sort(grid);
        return grid;
    }

    /// The best boundaries among the candidates; each list is in rising order. A dynamic programme
    /// finds them, because a layer's work depends only on its two boundaries.
    [[nodiscard]] Choice best_of(const std::vector<std::vector<double>>& candidates) const {
        constexpr double kInfinity = std::numeric_limits<double>::infinity();
        const auto square = [](double x) { return x * x; };
        std::vector<std::vector<double>> work(candidates.size());
        std::vector<std::vector<std::size_t>> from(candidates.size());
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            work[i].assign(candidates[i].size(), kInfinity);
            from[i].assign(candidates[i].size(), 0);
            const std::size_t inner_count = i == 0 ? 1 : candidates[i - 1].size();
            std::vector<double> per_area(inner_count);
            for (std::size_t k = 0; k < inner_count; ++k) {
                per_area[k] = weight(i) / square(factor(i, i == 0 ? 0.0 : candidates[i - 1][k]));
            }
            for (std::size_t j = 0; j < candidates[i].size(); ++j) {
                const double outer = candidates[i][j];
                const double area = square(width_px(1.0, outer));
                for (std::size_t k = 0; k < inner_count; ++k) {
                    if (i > 0 && candidates[i - 1][k] > outer) {
                        break;
                    }
                    const double sum = (i == 0 ? 0.0 : work[i - 1][k]) + per_area[k] * area;
                    if (sum < work[i][j]) {
                        work[i][j] = sum;
                        from[i][j] = k;
                    }
                }
            }
        }
        const std::size_t last = candidates.size() - 1;
        Choice best;
        std::size_t chosen = 0;
        for (std::size_t j = 0; j < candidates[last].size(); ++j) {
            const double sum = work[last][j] + weight(last + 1) * display_pixels() /
                                                   square(factor(last + 1, candidates[last][j]));
            if (sum < best.work) {
                best.work = sum;
                chosen = j;
            }
        }
        best.boundaries_deg.resize(candidates.size());
        for (std::size_t i = candidates.size(); i-- > 0;) {
            best.boundaries_deg[i] = candidates[i][chosen];
            chosen = from[i][chosen];
        }
        return best;
    }

    const LayerDisplay& display_;
    const MarLine& line_;
    const LayerOptions& options_;
};

}  // namespace

double LayerDisplay::sharpness_deg() const {
    return glm::degrees(std::atan(4.0 * half_width_tangent / width_px));
}

double LayerDisplay::radius_deg() const { return glm::degrees(std::atan(half_width_tangent)); }

Expected<EccentricityLayers> optimise_layers(const LayerDisplay& display, const MarLine& line,
                                             const LayerOptions& options) {
    if (const auto checked = check(display, line, options); !checked) {
        return std::unexpected(checked.error());
    }
    const Problem problem(display, line, options);
    Choice best;
    for (std::size_t layers = 1; layers <= static_cast<std::size_t>(options.layers); ++layers) {
        // More layers are taken only if they save work.
        if (auto choice = problem.solve(layers); choice && choice->work < best.work * (1 - 1e-9)) {
            best = std::move(*choice);
        }
    }
    EccentricityLayers result{
        .layers = {}, .work = best.work, .display_pixels = problem.display_pixels()};
    double inner = 0.0;
    for (std::size_t i = 0; i < best.boundaries_deg.size(); ++i) {
        const double outer = best.boundaries_deg[i];
        // A layer without extent is left out.
        if (outer > inner) {
            const double factor = problem.factor(i, inner);
            const double width = problem.width_px(factor, outer);
            result.layers.push_back({.radius_deg = outer,
                                     .factor = factor,
                                     .width_px = width,
                                     .pixels = width * width,
                                     .weight = problem.weight(i)});
        }
        inner = outer;
    }
    const std::size_t last = best.boundaries_deg.size();
    const double factor = problem.factor(last, inner);
    result.layers.push_back({.radius_deg = display.radius_deg(),
                             .factor = factor,
                             .width_px = display.width_px / factor,
                             .pixels = problem.display_pixels() / (factor * factor),
                             .weight = problem.weight(last)});
    return result;
}

}  // namespace gazeloop::foveation
