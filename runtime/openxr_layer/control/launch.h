#pragma once

#include <string>
#include <vector>

#include "runtime/error.h"

namespace gazeloop::openxr_layer {

/// Becomes another program, with the layer switched on in it and these settings (KEY=VALUE) in
/// force after the files'. Without a runtime of the user's choice it gets the one that gazeloop
/// would run on. Returns only if that fails: Usage for a setting that is none, BadInput where there
/// is no such program or no layer, NoDevice where there is no runtime.
Error launch(const std::vector<std::string>& command, const std::vector<std::string>& assignments);

}  // namespace gazeloop::openxr_layer
