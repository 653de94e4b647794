#pragma once

#include <memory>

#include "runtime/render/passes/method_passes.h"

namespace gazeloop::render {

/// Full resolution: one pass over the picture.
[[nodiscard]] std::unique_ptr<MethodPasses> make_full_passes(const PassSetup& setup);

}  // namespace gazeloop::render
