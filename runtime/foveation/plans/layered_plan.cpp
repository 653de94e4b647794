#include "runtime/foveation/plans/layered_plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <string>
#include <utility>

namespace gazeloop::foveation {
namespace {

frame::GridList names(std::size_t layers) {
    std::string text;
    for (std::size_t i = 1; i <= layers; ++i) {
        text += fmt::format("{}layer_{}", i > 1 ? " " : "", i);
    }
    return value_or_throw(frame::GridList::parse(text, frame::kMostGrids));
}

std::uint32_t bands_of(std::uint32_t rows) { return (rows + kBandRows - 1) / kBandRows; }

/// Rows of cells that no plan of a layer exceeds.
std::uint32_t most_rows(std::uint32_t height_px, const LayerShape& shape) {
    return static_cast<std::uint32_t>(std::ceil(height_px / shape.factor)) + 1;
}

/// Cells of rows [y0, y1) that visible pixels read, which each read the cells around them.
Columns visible_cells(const PlannedLayer& layer, const HiddenArea& hidden, std::uint32_t y0,
                      std::uint32_t y1) {
    const Tile& covers = layer.covers;
    const double px_down = 1.0 * (covers.y1 - covers.y0) / layer.height;
    const double px_across = 1.0 * (covers.x1 - covers.x0) / layer.width;
    const auto row = [&](double cells) {
        return static_cast<std::uint32_t>(
            std::clamp(covers.y0 + cells * px_down, 1.0 * covers.y0, covers.y1 - 1.0));
    };
    Columns pixels;
    const std::uint32_t last = row(y1 + 1.0);
    for (std::uint32_t y = row(y0 - 1.0) / HiddenArea::kGroupRows * HiddenArea::kGroupRows;
         y <= last; y += HiddenArea::kGroupRows) {
        const Columns visible = hidden.visible_columns(y);
        if (!visible.empty()) {
            pixels = pixels.empty() ? visible
                                    : Columns{std::min(pixels.first, visible.first),
                                              std::max(pixels.end, visible.end)};
        }
    }
    if (pixels.empty()) {
        return {};
    }
    const auto cell = [&](double cells) {
        return static_cast<std::uint32_t>(std::clamp(cells, 0.0, 1.0 * layer.width));
    };
    const double x0 = covers.x0;
    const Columns cells{cell(std::floor((pixels.first - x0) / px_across) - 1.0),
                        cell(std::ceil((pixels.end - x0) / px_across) + 1.0)};
    return cells.empty() ? Columns{} : cells;
}

/// As LayeredPlan::Layer states it.
glm::vec4 blend_of(const LayerShape& shape, const PlannedLayer& layer) {
    constexpr float kAtOnce = 1e6F;  // nothing is blended
    constexpr float kEverywhere = 2.0F;
    if (shape.share < 1.0) {
        const auto per_px = [&](std::uint32_t pixels) {
            const double blended = 0.5 * shape.blend * pixels;
            return blended > 0.0 ? static_cast<float>(1.0 / blended) : kAtOnce;
        };
        return {kEverywhere, 1.0F, per_px(layer.covers.x1 - layer.covers.x0),
                per_px(layer.covers.y1 - layer.covers.y0)};
    }
    if (shape.radius_deg >= 180.0) {
        return {kEverywhere, 1.0F, kAtOnce, kAtOnce};
    }
    const auto half_sine = [](double deg) { return std::sin(0.5 * glm::radians(deg)); };
    const double edge = half_sine(shape.radius_deg);
    const double inside = edge - half_sine((1.0 - shape.blend) * shape.radius_deg);
    return {static_cast<float>(edge), inside > 0.0 ? static_cast<float>(1.0 / inside) : kAtOnce,
            kAtOnce, kAtOnce};
}

}  // namespace

LayeredPlan::LayeredPlan(const LayeredOptions& options, LayersOf layers_of)
    : options_(options), layers_of_(std::move(layers_of)), grids_(names(options.layers)) {}

bool LayeredPlan::fits(const gaze::StereoView& views) const { return prepared_.fit(views); }

Expected<void> LayeredPlan::prepare(const gaze::StereoView& views) {
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        auto layers = layers_of_(views[e]);
        if (!layers) {
            return std::unexpected(layers.error());
        }
        layers_[e] = *std::move(layers);
    }
    prepared_.take(views);
    return {};
}

std::size_t LayeredPlan::table_words(std::uint32_t height_px) const {
    return 2 * options_.layers * std::size_t{bands_of(height_px + 1)};
}

void LayeredPlan::plan(gaze::Eye eye, const gaze::EyeView& view, const gaze::FoveaPoint& fovea,
                       const HiddenArea* hidden, const FrameInRun& frame, EyePlan& plan) const {
    const std::vector<LayerShape>& layers = layers_[gaze::index(eye)];
    const GazeField field = value_or_throw(GazeField::create(view, fovea.direction));
    plan.grids.resize(options_.layers);
    plan.table.clear();
    plan.table.reserve(table_words(view.height_px));
    plan.uniforms = {};
    for (std::size_t i = 0; i < options_.layers; ++i) {
        const LayerShape shape = i < layers.size() ? layers[i] : LayerShape{};
        plan.grids[i].start(most_rows(view.height_px, shape));
        if (i >= layers.size()) {
            continue;
        }
        const bool its_turn =
            i == 0 || !options_.half_rate || !frame.follows || (frame.index + i) % 2 == 0;
        const Layer layer =
            plan_shown(field, i, shape, options_.kept ? nullptr : hidden, its_turn, plan);
        plan.uniforms.at(3 * i) = layer.covers;
        plan.uniforms.at(3 * i + 1) = layer.cells;
        plan.uniforms.at(3 * i + 2) = layer.blend;
    }
    plan.uniforms[3 * kMostLayers] = glm::vec4(glm::vec3(field.gaze()), 0.0F);
}

LayeredPlan::Layer LayeredPlan::plan_shown(const GazeField& field, std::size_t layer,
                                           const LayerShape& shape, const HiddenArea* hidden,
                                           bool its_turn, EyePlan& plan) const {
    const PlannedLayer planned = plan_layer(field, shape);
    const Tile& covers = planned.covers;
    const std::size_t first_band = plan.table.size() / 2;
    Layer shown{.covers = glm::vec4(
                    glm::dvec4(covers.x0, covers.y0, covers.x1 - covers.x0, covers.y1 - covers.y0)),
                .cells = {static_cast<float>(planned.width), static_cast<float>(planned.height),
                          static_cast<float>(first_band), its_turn ? 1.0F : 0.0F},
                .blend = blend_of(shape, planned)};
    if (!its_turn) {
        return shown;
    }
    ShadedGrid& grid = plan.grids[layer];
    grid.counts.planned = std::uint64_t{planned.width} * planned.height;
    for (std::uint32_t y0 = 0; y0 < planned.height; y0 += kBandRows) {
        const std::uint32_t y1 = std::min(y0 + kBandRows, planned.height);
        const Columns all{0, planned.width};
        const Columns band = hidden != nullptr ? visible_cells(planned, *hidden, y0, y1) : all;
        grid.counts.shaded += std::uint64_t{y1 - y0} * (band.end - band.first);
        grid.bands.push_back(band);
        plan.table.push_back(band.first);
        plan.table.push_back(band.end);
    }
    grid.counts.hidden = grid.counts.planned - grid.counts.shaded;
    append_band_tiles(grid.bands, planned.height, grid.tiles);
    return shown;
}

LayeredPlan::Layer LayeredPlan::layer_of(const EyePlan& plan, std::size_t layer) {
    return {plan.uniforms.at(3 * layer), plan.uniforms.at(3 * layer + 1),
            plan.uniforms.at(3 * layer + 2)};
}

}  // namespace gazeloop::foveation
