#pragma once

#include <memory>

#include "runtime/render/passes/method_passes.h"

namespace gazeloop::render {

/// A method's passes and, after them, what works on its whole picture: "taa" mixes it with what the
/// last frames showed, and "post_filter" (or "encode", where there is none) writes it into the
/// target. The method draws into a picture of its own in linear light. Without any of these, and
/// where a post filter would find no periphery, it is the method's passes alone.
std::unique_ptr<MethodPasses> make_antialiased_passes(const PassSetup& setup,
                                                      const MakePasses& make_method);

}  // namespace gazeloop::render
