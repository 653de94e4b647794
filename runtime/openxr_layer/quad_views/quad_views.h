#pragma once

#include "runtime/openxr_layer/layered_instance.h"

namespace gazeloop::openxr_layer {

/// Fills the four views of an application from the two that the runtime has located for it: each
/// eye's inset is in its outer view, around where it is looked. Types and chains of `views` stay.
void fill_four_views(LayeredInstance& layered, XrSession session, XrTime display,
                     const gaze::PerEye<XrView>& two, XrView* views);

}  // namespace gazeloop::openxr_layer
