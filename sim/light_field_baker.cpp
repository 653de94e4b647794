#include "sim/light_field_baker.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "runtime/files/output_file.h"
#include "runtime/light_field/camera_grid.h"
#include "runtime/render/off_screen.h"
#include "runtime/render/passes/full_passes.h"
#include "runtime/render/png_file.h"
#include "runtime/scene/light_field_file.h"

namespace gazeloop::sim {
namespace {

constexpr std::string_view kUnfinished = "unfinished.txt";

std::string view_name(const light_field::CameraGrid& grid, std::uint32_t camera) {
    return scene::view_file_name(camera / grid.columns, camera % grid.columns);
}

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

/// Everything that decides the views, a line each.
std::string text_of(const LightFieldBake& bake) {
    std::string text = fmt::format(
        "views = {}\nsize_px = {}\nspacing_m = {}\nfield_deg = {}\nsamples = {}\nscene_time_s = "
        "{}\n",
        bake.views, bake.size_px, bake.spacing_m, bake.field_deg, bake.samples, bake.scene_time_s);
    for (const NamedValue& one : bake.of) {
        text += fmt::format("{} = {}\n", one.name, one.value);
    }
    return text;
}

/// As much of a file as text_of() may be; more of it, and it is none of ours.
std::string read_start(const std::filesystem::path& file) {
    constexpr std::size_t kMost = 65'536;
    std::string text(kMost, '\0');
    std::ifstream in(file);
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    return text;
}

/// The first line of one text that the other has not: "size_px = 32".
std::string first_other_line(const std::string& text, const std::string& other) {
    std::istringstream lines(text);
    std::istringstream others(other);
    std::string line;
    std::string other_line;
    while (std::getline(lines, line)) {
        if (!std::getline(others, other_line) || line != other_line) {
            return line;
        }
    }
    return {};
}

/// Makes the folder of a bake, or finds it as the same bake left it.
Expected<void> make_folder(const std::filesystem::path& folder, const LightFieldBake& bake) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) {
        return bad_folder(folder, fmt::format("the folder cannot be made ({})", error.message()));
    }
    const bool empty = std::filesystem::is_empty(folder, error);
    if (error || empty) {
        return error ? bad_folder(folder, fmt::format("cannot be read ({})", error.message()))
               : bake.of.empty() ? Expected<void>{}
                                 : files::write_text(folder / kUnfinished, text_of(bake));
    }
    if (bake.of.empty() || !std::filesystem::is_regular_file(folder / kUnfinished, error)) {
        return bad_folder(folder, "it holds something already: name a folder that is empty or new");
    }
    const std::string before = read_start(folder / kUnfinished);
    if (const std::string ours = text_of(bake); before != ours) {
        return bad_folder(folder,
                          fmt::format("it holds views of another light field, which is not "
                                      "finished ({} has '{}', not '{}'): name another folder, or "
                                      "ask for that one again",
                                      kUnfinished, first_other_line(before, ours),
                                      first_other_line(ours, before)));
    }
    return {};
}

/// The cameras whose views are missing. A view is there as a whole or not at all.
std::vector<std::uint32_t> missing_views(const light_field::CameraGrid& grid,
                                         const std::filesystem::path& folder) {
    std::vector<std::uint32_t> missing;
    for (std::uint32_t camera = 0; camera < grid.count(); ++camera) {
        std::error_code error;
        const auto size = std::filesystem::file_size(folder / view_name(grid, camera), error);
        if (error || size == 0) {
            missing.push_back(camera);
        }
    }
    return missing;
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
    if (auto made = make_folder(folder, bake); !made) {
        return std::unexpected(made.error());
    }
    render::RendererConfig config;
    config.samples = bake.samples;
    const vk::Extent2D extent(bake.size_px, bake.size_px);
    config.extents = {extent, extent};
    render::OffScreen renderer(context, scene, render::make_full_passes, config);
    const std::uint32_t total = grid->count();
    const std::vector<std::uint32_t> missing = missing_views(*grid, folder);
    if (missing.size() < total) {
        spdlog::info("{}: {} of {} views are there from before and are taken over", folder.string(),
                     total - missing.size(), total);
    }
    // Two cameras at a time, as if they were a person's eyes.
    for (std::size_t first = 0; first < missing.size(); first += gaze::kEyeCount) {
        render::FrameView frame{
            .index = first, .scene_time_s = bake.scene_time_s, .views = {}, .targets = {}};
        const auto camera_of = [&](std::size_t e) {
            return missing[std::min(first + e, missing.size() - 1)];
        };
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            frame.views[e] = view_of(*grid, camera_of(e), bake.size_px);
        }
        renderer.render(frame, render::fovea_ahead(frame.views));
        for (const gaze::Eye eye : gaze::kEyes) {
            const std::uint32_t camera = camera_of(gaze::index(eye));
            const std::filesystem::path file = folder / view_name(*grid, camera);
            if (auto written = render::write_png(renderer.picture(eye), file); !written) {
                return std::unexpected(written.error());
            }
        }
        const std::size_t left = missing.size() - std::min(first + 2, missing.size());
        if (!go_on(total - static_cast<std::uint32_t>(left), total)) {
            return std::unexpected(Error{
                ErrorKind::Interrupted,
                fmt::format("{}: interrupted, {} of {} views are missing{}", folder.string(), left,
                            total, bake.of.empty() ? "" : "; the same command goes on with them")});
        }
    }
    std::filesystem::path file = folder / fmt::format("views{}", scene::kLightFieldExtension);
    if (auto written = files::write_text(file, scene::light_field_text(*grid)); !written) {
        return std::unexpected(written.error());
    }
    std::error_code ignored;
    std::filesystem::remove(folder / kUnfinished, ignored);
    return file;
}

}  // namespace gazeloop::sim
