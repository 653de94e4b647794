#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "runtime/error.h"
#include "runtime/render/off_screen.h"
#include "runtime/render/snapshot.h"

namespace gazeloop::run {

/// The pictures that a run showed last, and how full resolution would have shown them.
struct RunSnapshot {
    const vulkan::Context& context;
    scene::Scene& scene;
    render::Snapshot& shown;
    const render::RendererConfig& config;         ///< of the run
    std::optional<render::MakePasses> full = {};  ///< none: the run was at full resolution
    std::filesystem::path folder = {};
    bool mark_fovea = false;
};

/// Writes them; gives the files. Errors: GateFailed where no frame was rendered, SessionLost where
/// Vulkan failed, and as render::Snapshot::write().
[[nodiscard]] Expected<std::vector<std::filesystem::path>> write_run_snapshot(
    const RunSnapshot& of_run);

}  // namespace gazeloop::run
