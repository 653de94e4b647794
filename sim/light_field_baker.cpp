#include "sim/light_field_baker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "runtime/files/output_file.h"
#include "runtime/light_field/camera_grid.h"
#include "runtime/render/off_screen.h"
#include "runtime/render/passes/full_passes.h"
#include "runtime/render/png_file.h"
#include "runtime/scene/light_field_file.h"

namespace gazeloop::sim {
namespace {

std::unexpected<Error> bad_folder(const std::filesystem::path& folder, const std::string& why) {
    return std::unexpected(Error{ErrorKind::BadInput, fmt::format("{}: {}", folder.string(), why)});
}

Expected<light_field::CameraGrid> grid_of(const LightFieldBake& bake) {
    const auto refuse = [](const std::string& why) {
        return std::unexpected(Error{ErrorKind::Usage, "simulate light-field: " + why});
    };
    if (!(bake.field_deg > 0.0 && bake.field_deg <= 178.0)) {
        return refuse(
            fmt::format("a field of view of {} deg: must lie in (0, 178]", bake.field_deg));
    }
    if (bake.size_px < 2 || bake.size_px > render::kMaxPngSide_px) {
        return refuse(fmt::format("views of {} px a side: must have 2 to {}", bake.size_px,
                                  render::kMaxPngSide_px));
    }
    const double tangent = std::tan(bake.field_deg * std::numbers::pi / 360.0);
    const light_field::CameraGrid grid{.columns = bake.views,
                                       .rows = bake.views,
                                       .spacing_m = bake.spacing_m,
                                       .half_tangents = {tangent, tangent}};
    if (const auto good = check(grid); !good) {
        return refuse(good.error().message);
    }
    return grid;
}

Expected<void> make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) {
        return bad_folder(folder, fmt::format("the folder cannot be made ({})", error.message()));
    }
    const bool empty = std::filesystem::is_empty(folder, error);
    if (error || !empty) {
        return bad_folder(folder, "it holds something already: name a folder that is empty or new");
    }
    return {};
}

gaze::EyeView view_of(const light_field::CameraGrid& grid, std::uint32_t camera,
                      std::uint32_t size_px) {
    const glm::dvec2 at_m = grid.camera_m(camera % grid.columns, camera / grid.columns);
    const double half_rad = std::atan(grid.half_tangents.x);
    return {.pose = {.position_m = {at_m.x, at_m.y, 0.0}},
            .fov = {-half_rad, half_rad, half_rad, -half_rad},
            .width_px = size_px,
            .height_px = size_px};
}

}  // namespace

Expected<std::filesystem::path> bake_light_field(
    const vulkan::Context& context, scene::Scene& scene, const LightFieldBake& bake,
    const std::filesystem::path& folder,
    const std::function<bool(std::uint32_t done, std::uint32_t total)>& go_on) {
    const auto grid = grid_of(bake);
    if (!grid) {
        return std::unexpected(grid.error());
    }
    if (auto made = make_folder(folder); !made) {
        return std::unexpected(made.error());
    }
    render::RendererConfig config;
    config.samples = bake.samples;
    const vk::Extent2D extent(bake.size_px, bake.size_px);
    config.extents = {extent, extent};
    render::OffScreen renderer(context, scene, render::make_full_passes, config);
    const std::uint32_t total = grid->count();
    // Two cameras at a time, as if they were a person's eyes.
    for (std::uint32_t first = 0; first < total; first += gaze::kEyeCount) {
        render::FrameView frame{
            .index = first, .scene_time_s = bake.scene_time_s, .views = {}, .targets = {}};
        const auto camera_of = [&](std::size_t e) {
            return std::min(first + static_cast<std::uint32_t>(e), total - 1);
        };
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            frame.views[e] = view_of(*grid, camera_of(e), bake.size_px);
        }
        renderer.render(frame, render::fovea_ahead(frame.views));
        for (const gaze::Eye eye : gaze::kEyes) {
            const std::uint32_t camera = camera_of(gaze::index(eye));
            const std::filesystem::path file =
                folder / scene::view_file_name(camera / grid->columns, camera % grid->columns);
            if (auto written = render::write_png(renderer.picture(eye), file); !written) {
                return std::unexpected(written.error());
            }
        }
        if (!go_on(std::min(first + 2, total), total)) {
            return std::unexpected(Error{ErrorKind::Interrupted,
                                         folder.string() + ": interrupted, views are missing"});
        }
    }
    std::filesystem::path file = folder / fmt::format("views{}", scene::kLightFieldExtension);
    if (auto written = files::write_text(file, scene::light_field_text(*grid)); !written) {
        return std::unexpected(written.error());
    }
    return file;
}

}  // namespace gazeloop::sim
