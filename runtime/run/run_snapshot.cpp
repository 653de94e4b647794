#include "runtime/run/run_snapshot.h"

#include <fmt/core.h>

namespace gazeloop::run {

Expected<std::vector<std::filesystem::path>> write_run_snapshot(const RunSnapshot& of_run) {
    if (!of_run.shown.any()) {
        return std::unexpected(
            Error{ErrorKind::GateFailed,
                  "--snapshot: no frame was rendered (a runtime asks for none at first): use more "
                  "--frames"});
    }
    try {
        std::optional<render::OffScreen> full;
        if (of_run.full) {
            render::RendererConfig config = of_run.config;
            config.hash = false;
            config.seen_depth = false;
            // A frame by itself has no last ones.
            config.antialiasing = {};
            config.depth_format = vk::Format::eUndefined;
            full.emplace(of_run.context, of_run.scene, *of_run.full, config);
        }
        return of_run.shown.write(full ? &*full : nullptr,
                                  {.folder = of_run.folder, .mark_fovea = of_run.mark_fovea});
    } catch (const SetupError& error) {
        return std::unexpected(Error{error.kind(), error.what()});
    } catch (const vk::SystemError& error) {
        return std::unexpected(Error{ErrorKind::SessionLost,
                                     fmt::format("--snapshot: Vulkan failed ({})", error.what())});
    }
}

}  // namespace gazeloop::run
