#pragma once

#include <string>

#include "tests/support/preload.h"

namespace gazeloop::tests {

// Environments under which a program's OpenXR runtime, Vulkan device or clocks misbehave.

inline std::string faults_folder() { return std::string(GAZELOOP_BINARY_DIR) + "/faults"; }

/// `plan`: see tests/support/openxr_layer.
inline Environment openxr_faults(const std::string& plan) {
    return {{"XR_API_LAYER_PATH", faults_folder() + "/openxr"},
            {"XR_ENABLE_API_LAYERS", "XR_APILAYER_GAZELOOP_faults"},
            {"GAZELOOP_OPENXR_FAULTS", plan}};
}

/// `plan`: see vulkan_fault_layer.cpp.
inline Environment vulkan_faults(const std::string& plan) {
    return {{"VK_LAYER_PATH", faults_folder() + "/vulkan"},
            {"VK_INSTANCE_LAYERS", "VK_LAYER_GAZELOOP_faults"},
            {"GAZELOOP_VULKAN_FAULTS", plan}};
}

/// The wall clock steps at every reading, see stepped_clocks.cpp.
inline Environment stepped_clocks() {
    return preloaded(faults_folder() + "/libgazeloop_stepped_clocks.so");
}

}  // namespace gazeloop::tests
