#pragma once

#include "runtime/vulkan/context.h"

namespace gazeloop::tests {

/// From now on the calls that a frame makes on the context's device are WatchedCalls. Functions
/// that are not listed in watched_vulkan.cpp count as the caller's own work: figures err upwards.
void watch_vulkan(const vulkan::Context& context);

}  // namespace gazeloop::tests
