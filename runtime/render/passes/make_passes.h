#pragma once

#include <functional>
#include <memory>

namespace gazeloop::render {

class MethodPasses;
struct PassSetup;

/// Throws SetupError (Usage) for parameters that the pictures do not allow.
using MakePasses = std::function<std::unique_ptr<MethodPasses>(const PassSetup&)>;

}  // namespace gazeloop::render
