#pragma once

#include <filesystem>
#include <vector>

#include "runtime/error.h"
#include "runtime/render/frame_renderer.h"

namespace gazeloop::render {

struct SnapshotOptions {
    std::filesystem::path folder;  ///< created if missing
    bool mark_fovea = false;
    double difference_gain = 4.0;
};

/// Creates the folder if it is missing. Errors (BadInput).
Expected<void> make_snapshot_folder(const std::filesystem::path& folder);

/// Renders a frame once more, off screen, and writes for each eye EYE-full.png (full resolution),
/// and for methods other than full also EYE-result.png, EYE-lp.png (the LP-buffer, black where the
/// plan left texels out) and EYE-difference.png. The request's targets are ignored.
/// Returns the files written. Errors (BadInput): the folder or a file cannot be written.
Expected<std::vector<std::filesystem::path>> write_snapshot(const vulkan::Context& context,
                                                            const RendererConfig& config,
                                                            const FrameRequest& request,
                                                            const SnapshotOptions& options);

}  // namespace gazeloop::render
