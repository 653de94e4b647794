#pragma once

#include <string>
#include <vector>

#include "runtime/named_value.h"

namespace gazeloop::vulkan {
class Context;
}

namespace gazeloop::run {

/// What decides a picture's bits beside the settings: the device, its driver, and the processor
/// where that renders. A session keeps it in its table `device`.
[[nodiscard]] std::vector<NamedValue> picture_device(const vulkan::Context& context);

/// Why a replay on `now` need not give the pictures recorded on `recorded`, both as above; empty if
/// it must. What one of them does not know decides nothing.
[[nodiscard]] std::string other_renderer(const std::vector<NamedValue>& recorded,
                                         const std::vector<NamedValue>& now);

}  // namespace gazeloop::run
