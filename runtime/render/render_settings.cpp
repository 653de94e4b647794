#include "runtime/render/render_settings.h"

#include <algorithm>
#include <utility>

#include "runtime/render/frame_uniforms.h"
#include "runtime/scene/light_field_file.h"
#include "runtime/scene/scene_file.h"
#include "runtime/scene/scenes.h"

namespace gazeloop::render {

Antialiasing antialiasing_of(const RenderSettings& render) {
    return {.post_filter_px = static_cast<std::uint32_t>(render.post_filter_px),
            .footprint_taps = static_cast<std::uint32_t>(render.footprint_taps),
            .over_frames = render.over_frames,
            .forget_at_landings = render.forget_at_landings};
}

FilterUse lp_gaussian_of(const RenderSettings& render) {
    return render.lp_gaussian == "on"    ? FilterUse::On
           : render.lp_gaussian == "off" ? FilterUse::Off
                                         : FilterUse::AsSceneNeeds;
}

CameraMotion camera_of(const RenderSettings& render) {
    const auto found = std::ranges::find(kCameraMotionNames, render.camera);
    return static_cast<CameraMotion>(found - kCameraMotionNames.begin());
}

std::vector<settings::SettingRow> rows_of(RenderSettings& render,
                                          std::vector<std::string> methods) {
    using settings::Choice;
    using settings::Concerns;
    using settings::Number;
    using settings::Whole;
    std::vector<std::string_view> files(scene::kSceneFileExtensions.begin(),
                                        scene::kSceneFileExtensions.end());
    files.push_back(scene::kLightFieldExtension);
    std::vector<std::string> scenes(scene::scene_names().begin(), scene::scene_names().end());
    scenes.emplace_back(scene::kBakedLightField);
    return {
        {"render.camera",
         "carries the viewer through the scene: turned to and fro (pan), or round a circle of 0.2 "
         "m "
         "at 0.025 m/s (fly-1), at twice that, ... 0.8 m/s (fly-6)",
         Choice{.value = &render.camera,
                .names = {kCameraMotionNames.begin(), kCameraMotionNames.end()}},
         Concerns::Picture},
        {"render.depth", "give depth images to the runtime where it takes them", &render.depth,
         Concerns::Output},
        {"render.footprint",
         "fade detail that is finer than the samples lie apart: highlights of meshes, the floor of "
         "raymarch",
         &render.footprint, Concerns::Picture},
        {"render.footprint_taps",
         "places within a pixel at which an LP-buffer is read; 1: its centre",
         Whole{&render.footprint_taps, 1, Antialiasing::kMostFootprintTaps}, Concerns::Picture},
        {"render.frames_in_flight", "frames that the GPU may work on at once",
         Whole{&render.frames_in_flight, 1, 3}, Concerns::Output},
        {"render.hidden_area", "do not shade what the headset shows to no eye", &render.hidden_area,
         Concerns::Picture},
        {"render.lp_gaussian",
         "smooth a log-polar buffer's periphery by a 3 x 3 Gaussian: off, on, or where the scene "
         "needs it",
         Choice{.value = &render.lp_gaussian, .names = {"off", "on", "scene"}}, Concerns::Picture},
        {"render.method", "foveation method: which samples a picture takes",
         Choice{.value = &render.method, .names = std::move(methods)}, Concerns::Picture},
        {"render.post_filter",
         "largest size of the Gaussian over the resolved periphery (KFR's eta), px; 0: none",
         Whole{&render.post_filter_px, 0, Antialiasing::kMostPostFilter_px}, Concerns::Picture},
        {"render.profile", "time every pass separately, with one submit per pass", &render.profile,
         Concerns::Output},
        {"render.require",
         "scene: leave out what the scene does not need; all: do it, to measure what that saves",
         Choice{.value = &render.require, .names = {"scene", "all"}}, Concerns::Output},
        // Views are recorded with their sizes.
        {"render.scale", "picture size relative to the display's, each way",
         Number{&render.scale, 0.01, 2.0}, Concerns::Input},
        {"render.scene", "scene to render: a name, or a .gltf, .glb or .lightfield file",
         Choice{.value = &render.scene,
                .names = std::move(scenes),
                .file_extensions = std::move(files)},
         Concerns::Picture},
        {"render.specular_filter",
         "make highlights of meshes as wide as surfaces turn within a pixel",
         &render.specular_filter, Concerns::Picture},
        {"render.spp", "samples per texel or pixel", Whole{&render.spp, 1, kMaxSamples},
         Concerns::Picture},
        {"render.taa", "move samples from frame to frame and mix in what the last frames showed",
         &render.over_frames, Concerns::Picture},
        {"render.taa_reset",
         "with render.taa: forget the last frames where a saccade lands",
         &render.forget_at_landings,
         Concerns::Picture,
         {"render.taa", {"true"}}},
        {"render.wait_before_latch",
         "read the gaze only when the GPU has finished what needs no gaze: the G-buffer of meshes",
         &render.wait_before_latch, Concerns::Output},
    };
}

}  // namespace gazeloop::render
