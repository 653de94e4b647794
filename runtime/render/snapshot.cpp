#include "runtime/render/snapshot.h"

#include <fmt/core.h>

#include <system_error>

#include "runtime/render/picture.h"

namespace gazeloop::render {
namespace {

struct Rendered {
    gaze::PerEye<Picture> result;
    gaze::PerEye<Picture> lp;  ///< empty for full resolution
    gaze::PerEye<double> disc_radius_px{};
};

Rendered render_off_screen(const vulkan::Context& context, RendererConfig config,
                           FrameRequest request) {
    config.hash = false;
    config.depth_format = vk::Format::eUndefined;
    config.lp_background = {0.0F, 0.0F, 0.0F, 1.0F};
    FrameRenderer renderer(context, config);
    gaze::PerEye<vulkan::ColorImage> images;
    for (const gaze::Eye eye : gaze::kEyes) {
        const std::size_t e = gaze::index(eye);
        images[e] = vulkan::ColorImage(
            context, config.extents[e], config.format,
            vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc);
        request.targets[e] = {images[e].image(), images[e].view()};
    }
    renderer.wait_for_slot();
    renderer.render(request);
    renderer.wait_idle();
    Rendered rendered;
    for (const gaze::Eye eye : gaze::kEyes) {
        const std::size_t e = gaze::index(eye);
        rendered.result[e] = read_back(context, images[e].image(), config.extents[e], config.format,
                                       vk::ImageLayout::eColorAttachmentOptimal);
        const LogPolarEye* const log_polar = renderer.log_polar_eye(eye);
        if (log_polar != nullptr && !renderer.last_plan(eye).lp_tiles.empty()) {
            const vulkan::ColorImage& lp = log_polar->lp_buffer();
            rendered.lp[e] = read_back(context, lp.image(), lp.extent(), lp.format(),
                                       vk::ImageLayout::eShaderReadOnlyOptimal);
            rendered.disc_radius_px[e] = renderer.last_plan(eye).disc_radius_px;
        }
    }
    return rendered;
}

}  // namespace

Expected<void> make_snapshot_folder(const std::filesystem::path& folder) {
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure) {
        return std::unexpected(
            Error{ErrorKind::BadInput, fmt::format("--snapshot {}: the folder cannot be made ({})",
                                                   folder.string(), failure.message())});
    }
    return {};
}

Expected<std::vector<std::filesystem::path>> write_snapshot(const vulkan::Context& context,
                                                            const RendererConfig& config,
                                                            const FrameRequest& request,
                                                            const SnapshotOptions& options) {
    if (const auto made = make_snapshot_folder(options.folder); !made) {
        return std::unexpected(made.error());
    }
    RendererConfig full_config = config;
    full_config.method = Method::Full;
    Rendered full = render_off_screen(context, full_config, request);
    Rendered foveated;
    if (config.method != Method::Full) {
        foveated = render_off_screen(context, config, request);
    }

    std::vector<std::filesystem::path> files;
    for (const gaze::Eye eye : gaze::kEyes) {
        const std::size_t e = gaze::index(eye);
        const auto write = [&](Picture& picture, std::string_view what,
                               bool in_screen_space) -> Expected<void> {
            if (picture.pixels.empty()) {
                return {};
            }
            if (in_screen_space && options.mark_fovea) {
                const double disc = foveated.disc_radius_px[e];
                mark_fovea(picture, request.foveae[e], disc > 0.0 ? disc : kRingWithoutDisc_px);
            }
            files.push_back(options.folder / fmt::format("{}-{}.png", gaze::kEyeNames[e], what));
            return write_png(picture, files.back());
        };
        Picture difference;
        if (config.method != Method::Full) {
            difference =
                amplified_difference(foveated.result[e], full.result[e], options.difference_gain);
        }
        for (const auto& [picture, what, in_screen_space] :
             {std::tuple{&full.result[e], "full", true},
              {&foveated.result[e], "result", true},
              {&foveated.lp[e], "lp", false},
              {&difference, "difference", true}}) {
            if (const auto written = write(*picture, what, in_screen_space); !written) {
                return std::unexpected(written.error());
            }
        }
    }
    return files;
}

}  // namespace gazeloop::render
