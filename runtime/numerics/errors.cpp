#include "runtime/numerics/errors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gazeloop::numerics {
namespace {

using foveation::LpShare;
using gaze::PixelPosition;

constexpr std::size_t kSeamPositions = 64;
constexpr std::size_t kLines = 4;

double distance_px(const PixelPosition& a, const PixelPosition& b) {
    return std::hypot(a.x_px - b.x_px, a.y_px - b.y_px);
}

/// A position as the float that is handed to the map, and the texel that it lies in.
ProbeInput probe_at(const MapUnderTest& map, const PixelPosition& position) {
    ProbeInput input{
        .position_px = {static_cast<float>(position.x_px), static_cast<float>(position.y_px)}};
    const LpShare share = map.exact().share({input.position_px.x, input.position_px.y});
    const auto texel = [](double s, std::uint32_t size) {
        return static_cast<float>(std::clamp(std::floor(s * size), 0.0, size - 1.0));
    };
    input.cell = {texel(share.u, map.lp().width), texel(share.v, map.lp().height)};
    return input;
}

bool has_consequences(const MapUnderTest& map, const LpShare& share) {
    const double column = share.u * map.lp().width;
    return column >= 0.5 && column <= map.lp().width - 0.5;
}

/// The largest step back of u, over positions in the order of their exact u, as a distance.
double fall_px(const MapUnderTest& map, std::span<const ProbeInput> inputs,
               std::span<const ProbeOutput> outputs) {
    struct Step {
        double exact;
        double answered;
        double v;
    };
    std::vector<Step> steps;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const glm::vec2& at = inputs[i].position_px;
        const LpShare share = map.exact().share({at.x, at.y});
        if (has_consequences(map, share)) {
            steps.push_back({share.u, outputs[i].share.x, share.v});
        }
    }
    std::ranges::sort(steps, {}, &Step::exact);
    double greatest = 0.0;
    double fall = 0.0;
    for (const Step& step : steps) {
        if (step.answered < greatest) {
            const auto from = map.exact().position({greatest, step.v});
            const auto to = map.exact().position({step.answered, step.v});
            if (from && to) {
                fall = std::max(fall, distance_px(*from, *to));
            }
        }
        greatest = std::max(greatest, step.answered);
    }
    return fall;
}

}  // namespace

Probes make_probes(const MapUnderTest& map, foveation::ImageSize image, std::size_t positions,
                   std::mt19937_64& random) {
    const double width = image.width_px;
    const double height = image.height_px;
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const auto pixel = [&](double x, double y) {
        return PixelPosition{std::clamp(std::floor(x), 0.0, width - 1.0) + 0.5,
                             std::clamp(std::floor(y), 0.0, height - 1.0) + 0.5};
    };
    const auto anywhere = [&] { return pixel(unit(random) * width, unit(random) * height); };
    Probes probes;
    for (std::size_t i = 0; i < positions; ++i) {
        if (i % 2 == 0) {
            probes.inputs.push_back(probe_at(map, anywhere()));
            continue;
        }
        const double r = std::pow(std::hypot(width, height), unit(random));
        const double angle = unit(random) * 2.0 * std::numbers::pi;
        probes.inputs.push_back(probe_at(map, pixel(map.fovea().x_px + r * std::cos(angle),
                                                    map.fovea().y_px + r * std::sin(angle))));
    }
    probes.seam_begin = probes.inputs.size();
    for (std::size_t i = 0; i < kSeamPositions; ++i) {
        const double u = map.exact().share(anywhere()).u;
        for (const double v : {0.0, 1e-12, 1e-9, 1e-6, 1.0 - 1e-6, 1.0 - 1e-9, 1.0 - 1e-12}) {
            const auto at = map.exact().position({u, v});
            if (at && at->x_px > 0.0 && at->x_px < width && at->y_px > 0.0 && at->y_px < height) {
                probes.inputs.push_back(probe_at(map, *at));
            }
        }
    }
    probes.line_begin = probes.inputs.size();
    for (std::size_t line = 0; line < kLines; ++line) {
        const PixelPosition end = anywhere();
        // Half of a line in steps over all of it, half in steps of a hundredth of a pixel.
        for (std::size_t i = 0; i < kLineLength; ++i) {
            const double share = i < kLineLength / 2
                                     ? static_cast<double>(i) / (kLineLength / 2.0)
                                     : 1.0 + 0.01 * (static_cast<double>(i) - kLineLength) /
                                                 distance_px(end, map.fovea());
            probes.inputs.push_back(probe_at(map, {std::lerp(map.fovea().x_px, end.x_px, share),
                                                   std::lerp(map.fovea().y_px, end.y_px, share)}));
        }
    }
    return probes;
}

EnvelopeRow::Errors judge(const MapUnderTest& map, const Probes& probes,
                          const std::vector<ProbeOutput>& outputs, EnvelopeRow& row) {
    const double reach_px = 2.0 * std::hypot(row.image.width_px, row.image.height_px);
    EnvelopeRow::Errors errors;
    for (std::size_t i = 0; i < probes.inputs.size(); ++i) {
        const ProbeInput& input = probes.inputs[i];
        const ProbeOutput& output = outputs[i];
        if (!std::isfinite(output.share.x + output.share.y + output.place.x + output.place.y +
                           output.place.z)) {
            ++errors.not_finite;
            continue;
        }
        if (i >= probes.line_begin) {
            continue;
        }
        const PixelPosition position{input.position_px.x, input.position_px.y};
        const LpShare share = map.exact().share(position);
        const auto back = map.exact().position({output.share.x, output.share.y});
        if (has_consequences(map, share) && back) {
            const double error = distance_px(*back, position);
            double& worst = i < probes.seam_begin ? errors.forward_px : errors.seam_px;
            worst = std::max(worst, error);
            const double bound = map.forward_bound_px(position);
            row.beyond_bound += error > bound ? 1 : 0;
            row.forward_bound_px = std::max(row.forward_bound_px, bound);
            row.conditioning_px = std::max(
                row.conditioning_px, foveation::MapError::conditioning_px(map.exact(), position));
            row.forward_texels =
                std::max(row.forward_texels, std::abs(output.share.x - share.u) * map.lp().width);
        }
        const LpShare centre{(input.cell.x + 0.5) / map.lp().width,
                             (input.cell.y + 0.5) / map.lp().height};
        const auto exact = map.exact().position(centre);
        const auto placed = map.placed(output.place);
        // A texel that only touches the screen may have its centre far from it. There, at nearly a
        // right angle from the view's axis, the smallest angle may be any number of pixels.
        if (exact && placed && distance_px(*exact, position) <= reach_px) {
            const double error = distance_px(*placed, *exact);
            errors.inverse_px = std::max(errors.inverse_px, error);
            const double bound = map.inverse_bound_px(centre);
            row.beyond_bound += error > bound ? 1 : 0;
            row.inverse_bound_px = std::max(row.inverse_bound_px, bound);
        }
    }
    for (std::size_t begin = probes.line_begin; begin < probes.inputs.size();
         begin += kLineLength) {
        errors.fall_px = std::max(errors.fall_px,
                                  fall_px(map, std::span(probes.inputs).subspan(begin, kLineLength),
                                          std::span(outputs).subspan(begin, kLineLength)));
    }
    return errors;
}

}  // namespace gazeloop::numerics
