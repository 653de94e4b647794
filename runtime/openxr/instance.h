#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "runtime/openxr/runtime_choice.h"
#include "runtime/openxr/xr_check.h"

namespace gazeloop::openxr {

struct InstanceOptions {
    bool validation = false;          ///< the core validation layer
    std::vector<const char*> wanted;  ///< extensions that are enabled where the runtime offers them
};

/// A runtime's instance and its head-mounted display.
class Instance {
  public:
    /// Throws SetupError (NoDevice) with the remedy when the runtime does not start, lacks what
    /// kRequiredXrExtensions asks for, or has no head-mounted display.
    Instance(const RuntimeChoice& choice, const InstanceOptions& options);
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;
    ~Instance();

    [[nodiscard]] XrInstance handle() const { return instance_; }
    [[nodiscard]] XrSystemId system() const { return system_; }
    [[nodiscard]] const std::string& runtime_name() const { return runtime_name_; }
    [[nodiscard]] const std::string& system_name() const { return system_name_; }

    /// Whether an extension that was wanted is there.
    [[nodiscard]] bool has(std::string_view extension) const;

  private:
    XrInstance instance_ = XR_NULL_HANDLE;
    XrSystemId system_ = XR_NULL_SYSTEM_ID;
    std::string runtime_name_;
    std::string system_name_;
    std::vector<const char*> enabled_;
};

/// A path of OpenXR by its text. Throws SetupError.
[[nodiscard]] XrPath path_of(XrInstance instance, const char* text);

}  // namespace gazeloop::openxr
