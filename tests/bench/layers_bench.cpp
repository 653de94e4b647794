#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "runtime/scene/gallery/gallery_scene.h"
#include "runtime/scene/mesh_scene.h"
#include "tests/bench/bench.h"
#include "tests/bench/timed_method.h"
#include "tests/support/method_by_settings.h"

namespace gazeloop::bench {
namespace {

constexpr vk::Extent2D kExtent(1920, 1080);
constexpr vk::Extent2D kQuickPicture(480, 270);
/// The paper's display: 51 cm wide, seen from 59 cm.
constexpr double kHalfWidth = 51.0 / (2.0 * 59.0);
constexpr std::size_t kFrames = 2;  ///< a turn of each layer that is shaded at half rate

/// The content of the paper's Table 1, row by row.
struct Row {
    const char* name;
    bool objects = true;
    bool terrain = true;
    bool cheap_terrain = false;
    bool clouds = true;
};
constexpr std::array kRows{
    Row{.name = "full"},
    Row{.name = "cheap-terrain", .cheap_terrain = true},
    Row{.name = "no-objects", .objects = false},
    Row{.name = "no-terrain", .terrain = false},
    Row{.name = "no-sky", .clouds = false},
    Row{.name = "no-render", .objects = false, .terrain = false, .clouds = false}};

/// Its columns: three eyes (the paper does not state the slope of its informal one: the greatest
/// that it calls usable), and full resolution without antialiasing, with several samples per pixel,
/// and over frames too.
struct Column {
    const char* name;
    const char* method;
    bool antialiased;
    std::vector<NamedValue> set;
    std::optional<double> target;  ///< of N2 over it, full content
};
const std::array kColumns{
    Column{"I", "layers", true, {{"acuity.mar", "0.034"}}, std::nullopt},
    Column{"A", "layers", true, {{"acuity.mar", "0.0275"}}, 5.7},
    Column{"B", "layers", true, {{"acuity.mar", "0.022"}}, 4.8},
    Column{"N0", "full", false, {}, std::nullopt}, Column{"N1", "full", true, {}, std::nullopt},
    // One layer that has every pixel.
    Column{"N2",
           "layers",
           true,
           {{"acuity.mar", "0.0001"}, {"layers.n", "2"}, {"layers.half_rate", "false"}},
           std::nullopt}};

/// The gallery with what a row has of it. Its terrain has no coarser form, its objects have.
scene::mesh::MeshData content_of(const Row& row) {
    scene::mesh::MeshData data = scene::gallery::gallery_scene();
    const auto is_terrain = [](const scene::mesh::Instance& instance) {
        return instance.level_count == 1;
    };
    if (row.cheap_terrain) {
        const auto terrain = std::ranges::find_if(data.instances, is_terrain);
        const std::uint32_t primitive = data.levels.at(terrain->first_level).primitive;
        scene::mesh::Material& ground = data.materials.at(data.primitives.at(primitive).material);
        ground = {.name = "cheap", .base_color = ground.base_color, .unlit = true};
    }
    std::erase_if(data.instances, [&](const scene::mesh::Instance& instance) {
        return is_terrain(instance) ? !row.terrain : !row.objects;
    });
    if (!row.clouds) {
        data.sky.clouds = 0.0F;
    }
    return data;
}

/// Passes that shade: what fewer samples can make faster.
double shading_ms(const TimedMethod& method) {
    double ms = method.pass_ms("full");
    for (const std::string_view layer : {"layer_1", "layer_2", "layer_3", "layer_4"}) {
        ms += method.pass_ms(layer);
    }
    return ms;
}

void measure(const vulkan::Context& context, const Row& row, const Options& options,
             std::vector<Figure>& figures) {
    const auto scene = scene::make_mesh_scene(context, content_of(row), {});
    render::RendererConfig config;
    const vk::Extent2D extent = options.quick ? kQuickPicture : kExtent;
    config.extents = {extent, vk::Extent2D(8, 8)};
    render::FrameView frame;
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        const double half_rad = std::atan(kHalfWidth);
        const double half_high_rad = std::atan(kHalfWidth * extent.height / extent.width);
        frame.views[e] = {.fov = {-half_rad, half_rad, half_high_rad, -half_high_rad},
                          .width_px = config.extents[e].width,
                          .height_px = config.extents[e].height};
    }
    const gaze::FrameFovea fovea = render::fovea_ahead(frame.views);
    std::vector<std::unique_ptr<TimedMethod>> columns;
    for (const Column& column : kColumns) {
        config.samples = column.antialiased ? options.samples.value_or(4) : 1;
        columns.push_back(std::make_unique<TimedMethod>(context, column.name, *scene,
                                                        tests::passes_by(column.method, column.set),
                                                        config, kFrames));
        columns.back()->warm_up(context, frame.views);
    }
    for (unsigned round = 0; round < options.rounds; ++round) {
        for (std::size_t i = 0; i < kFrames; ++i) {
            frame.index = round * kFrames + i;
            for (const auto& column : columns) {
                column->frame(i, frame, fovea);
            }
        }
    }
    const TimedMethod& n2 = *columns.back();
    const double fixed_ms = n2.ms() - shading_ms(n2);
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const TimedMethod& column = *columns[i];
        const auto put = [&](const char* metric, double value, const char* unit,
                             const char* better) -> Figure& {
            return figures.emplace_back(Figure{"layers", row.name,
                                               fmt::format("{} {}", column.name(), metric), value,
                                               unit, better});
        };
        put("total", column.ms(), "ms", "lower");
        put("over N2, processor", n2.processor_ms() / column.processor_ms(), "x", "higher");
        Figure& speedup = put("over N2", n2.ms() / column.ms(), "x", "higher");
        // What no number of samples changes: geometry at full resolution, and the composite.
        const double share = std::min(column.samples() / n2.samples(), 1.0);
        speedup.bound = n2.ms() / (fixed_ms + share * shading_ms(n2));
        if (&row == kRows.data()) {
            speedup.target = kColumns.at(i).target;
        }
        if (std::string_view(kColumns.at(i).method) == "layers") {
            put("fewer samples", n2.samples() / column.samples(), "x", "higher");
            for (std::size_t pass = 0; pass < column.passes().size(); ++pass) {
                put(column.passes()[pass].c_str(), column.pass_ms(pass), "ms", "lower");
            }
        }
    }
}

}  // namespace

std::vector<Figure> layers(const Options& options) {
    const vulkan::Context context({}, nullptr);
    std::vector<Figure> figures;
    for (const Row& row : kRows) {
        if (options.wants(row.name)) {
            measure(context, row, options, figures);
        }
    }
    return figures;
}

}  // namespace gazeloop::bench
