#pragma once

#include <memory>

#include "runtime/render/passes/method_passes.h"

namespace gazeloop::render {

/// A method's passes with the fovea held straight ahead.
[[nodiscard]] std::unique_ptr<MethodPasses> make_fixed_passes(std::unique_ptr<MethodPasses> held);

}  // namespace gazeloop::render
