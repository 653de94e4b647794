#include "runtime/render/scene_options.h"

namespace gazeloop::render {

scene::SceneOptions scene_options(const RenderSettings& render,
                                  const scene::LightFieldSettings& light_field) {
    return {.require_all = render.require == "all",
            .specular_filter = render.specular_filter,
            .footprint = render.footprint,
            .light_field = light_field};
}

}  // namespace gazeloop::render
