#include "runtime/foveation/plans/kfr3d_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace gazeloop::foveation {
namespace {

frame::GridList grid_list(std::uint32_t regions) {
    std::string names;
    for (std::uint32_t region = 0; region < regions; ++region) {
        names += fmt::format("lp_{} ", region);
    }
    return value_or_throw(frame::GridList::parse(names + "picture", frame::kMostGrids));
}

/// Where the gaze is in the cameras' plane: as far from the lens's middle towards its reach as the
/// fovea is from the picture's middle towards its edge (the paper shows light fields on a screen,
/// and takes the gaze's place on it for its place among the cameras).
glm::dvec2 gaze_place_m(const light_field::ViewsInLens& lens, const gaze::EyeView& view,
                        const gaze::PixelPosition& fovea) {
    const glm::dvec2 half{0.5 * view.width_px, 0.5 * view.height_px};
    const glm::dvec2 aside{(fovea.x_px - half.x) / half.x, (half.y - fovea.y_px) / half.y};
    const double length = glm::length(aside);
    const glm::dvec2 within = length > 1.0 ? aside / length : aside;
    return lens.middle_m() + lens.reach_m() * within;
}

}  // namespace

std::uint32_t region_of(const Kfr3dParameters& parameters, double distance_m, double reach_m) {
    const double inner_m = parameters.inner * reach_m;
    if (parameters.regions == 1 || distance_m <= inner_m) {
        return 0;
    }
    // The regions beyond the foveal one are equally wide up to the reach.
    const double width_m = (reach_m - inner_m) / (parameters.regions - 1);
    const double beyond = width_m > 0.0 ? (distance_m - inner_m) / width_m : parameters.regions;
    return 1 + static_cast<std::uint32_t>(std::clamp(beyond, 0.0, parameters.regions - 2.0));
}

Expected<std::array<LpSize, Kfr3dParameters::kMostRegions>> region_sizes(
    const Kfr3dParameters& parameters, ImageSize image) {
    const auto foveal = lp_buffer_size(parameters.kfr, image);
    if (!foveal) {
        return std::unexpected(foveal.error());
    }
    std::array<LpSize, Kfr3dParameters::kMostRegions> sizes;
    const double most = KfrParameters::kMaxSigma / parameters.kfr.sigma;
    for (std::size_t region = 0; region < sizes.size(); ++region) {
        const double coarser =
            std::min(std::pow(parameters.growth, static_cast<double>(region)), most);
        const auto side = [&](std::uint32_t texels, std::uint32_t least) {
            return std::max(static_cast<std::uint32_t>(std::lround(texels / coarser)), least);
        };
        sizes.at(region) = region == 0 ? *foveal
                                       : LpSize{side(foveal->width, LpSize::kMinWidth),
                                                side(foveal->height, LpSize::kMinHeight)};
    }
    return sizes;
}

Kfr3dPlan::Kfr3dPlan(const Kfr3dParameters& parameters, const light_field::LightField& field)
    : parameters_(parameters),
      field_(field),
      grids_(grid_list(parameters.regions)),
      foveal_(parameters.kfr) {}

Expected<void> Kfr3dPlan::prepare(const gaze::StereoView& views) {
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        const auto sizes = region_sizes(parameters_, {views[e].width_px, views[e].height_px});
        if (!sizes) {
            return std::unexpected(sizes.error());
        }
        lp_[e] = *sizes;
    }
    return foveal_.prepare(views);
}

std::size_t Kfr3dPlan::table_words() const {
    return kViewsBegin + kViewWords * std::size_t{field_.cameras.count()};
}

/// Region by region, so that each is one run.
void Kfr3dPlan::list_views(const gaze::EyeView& view, const gaze::FoveaPoint& fovea,
                           std::vector<std::uint32_t>& table) const {
    const light_field::ViewsInLens lens(field_, view.pose.position_m);
    const glm::dvec2 gaze_m = gaze_place_m(lens, view, fovea.position);
    const auto region = [&](const light_field::WeightedView& of) {
        return region_of(parameters_, glm::distance(of.camera_m, gaze_m), lens.reach_m());
    };
    table.reserve(table_words());
    table.assign(kViewsBegin, 0);
    std::array<std::uint32_t, Kfr3dParameters::kMostRegions> next{};
    lens.for_each([&](const light_field::WeightedView& of) { ++next.at(region(of)); });
    for (std::size_t r = 0; r < next.size(); ++r) {
        table[r + 1] = table[r] + next.at(r);
        next.at(r) = table[r];
    }
    table.resize(kViewsBegin + kViewWords * table[next.size()]);
    lens.for_each([&](const light_field::WeightedView& of) {
        const std::size_t at = kViewsBegin + kViewWords * next.at(region(of))++;
        const auto word = [](double value) {
            return std::bit_cast<std::uint32_t>(static_cast<float>(value));
        };
        table[at] = word(of.camera_m.x);
        table[at + 1] = word(of.camera_m.y);
        table[at + kViewNumber] = word(of.view);
        table[at + 3] = word(of.weight);
    });
}

void Kfr3dPlan::plan(gaze::Eye eye, const gaze::EyeView& view, const gaze::FoveaPoint& fovea,
                     const HiddenArea* hidden, const FrameInRun& /*frame*/, EyePlan& plan) const {
    list_views(view, fovea, plan.table);
    const auto& sizes = lp_[gaze::index(eye)];
    const ImageSize image{view.width_px, view.height_px};
    plan.grids.resize(grids_.size());
    LogPolarPlan made;
    made.texels = std::move(plan.grids[0]);
    made.disc = std::move(plan.grids[disc_grid()]);
    plan_kfr(parameters_.kfr, sizes[0], image, fovea.position, made, hidden);
    put_map_uniforms(map_uniforms(made), plan);
    plan.ring_px = made.disc_radius_px;
    // One disc for all: outside it, every region's texels are read as the foveal one's are.
    const LogPolarMap map(parameters_.kfr.kernel, image, fovea.position);
    const double core = core_u(map, made);
    plan.grids[disc_grid()] = std::move(made.disc);
    for (std::size_t region = 0; region < parameters_.regions; ++region) {
        if (region > 0) {
            made.lp = sizes.at(region);
            made.texels = std::move(plan.grids[region]);
            plan_lp_tiles(map, core, hidden, made);
        }
        if (views_in(plan.table, region) == 0) {
            made.texels.start(sizes.at(region).height);
        }
        plan.grids[region] = std::move(made.texels);
    }
}

}  // namespace gazeloop::foveation
