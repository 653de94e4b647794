#pragma once

#include "runtime/methods/method_settings.h"
#include "runtime/render/render_settings.h"
#include "runtime/scene/light_field_settings.h"

namespace gazeloop::trade {

/// What a sweep's points are rendered by: the live values of its settings' rows.
struct SweptValues {
    const methods::MethodSettings& methods;
    const render::RenderSettings& render;
    const scene::LightFieldSettings& light_field;
};

}  // namespace gazeloop::trade
