#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "runtime/error.h"
#include "runtime/named_value.h"
#include "runtime/scene/scene.h"
#include "runtime/vulkan/context.h"

namespace gazeloop::sim {

/// A light field to make of a scene, seen from around its viewer's starting point.
struct LightFieldBake {
    std::uint32_t views = 25;      ///< a side of the square grid of cameras, [1, 64]
    std::uint32_t size_px = 1024;  ///< a side of every view, [2, 16384]
    double spacing_m = 0.005;      ///< between neighbouring cameras, [1e-6, 10]
    double field_deg = 100.0;      ///< field of view of every view, both ways, (0, 178]
    std::uint32_t samples = 1;     ///< per pixel, [1, 16]
    double scene_time_s = 0.0;
    /// What else decides the pictures: the scene's name, state and so on. Views that were rendered
    /// by the same words are taken over. Empty: none are.
    std::vector<NamedValue> of{};
};

/// Renders the scene from every camera at full resolution and writes what
/// scene::open_light_field reads: `views.lightfield` and the views, into a folder that is made. Its
/// name is returned. `go_on(done, total)` is asked after every pair of views; false ends it
/// (Interrupted). With LightFieldBake::of, the same bake then goes on with the views that are
/// missing; it finds what it was in the folder's `unfinished.txt`. Errors: a value out of range
/// (Usage); a folder that holds something else already, or cannot be written (BadInput).
Expected<std::filesystem::path> bake_light_field(
    const vulkan::Context& context, scene::Scene& scene, const LightFieldBake& bake,
    const std::filesystem::path& folder,
    const std::function<bool(std::uint32_t done, std::uint32_t total)>& go_on);

}  // namespace gazeloop::sim
