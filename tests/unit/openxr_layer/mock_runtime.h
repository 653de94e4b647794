#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "runtime/openxr/xr_check.h"
#include "runtime/openxr_layer/loader_interface.h"

namespace gazeloop::openxr_layer {

/// An OpenXR runtime without eyes, display or loader, below the layer in this process. It knows no
/// eye gaze, gives the handles that are asked for, refuses handles that it did not give, and its
/// head turns steadily. Not for several threads.
class MockRuntime {
  public:
    static MockRuntime& the();

    /// As nothing had ever been made. `fail_next`: the next call of a function of that name fails.
    void reset();
    void fail_next(const std::string& function, XrResult result) { failures_[function] = result; }

    /// An instance through the layer, with these extensions; its functions by their names.
    XrResult create_through_layer(const std::vector<const char*>& extensions, XrInstance& instance);
    template <typename Function>
    [[nodiscard]] static Function through_layer(XrInstance instance, const char* name) {
        return reinterpret_cast<Function>(find_through_layer(instance, name));
    }

    [[nodiscard]] static XrTime now();
    /// Paths and extensions that only the layer should know came through to here.
    [[nodiscard]] bool saw_eyes() const { return saw_eyes_; }
    [[nodiscard]] bool focused() const { return focused_; }
    void set_focused(bool focused) { focused_ = focused; }

    // What the functions below use.

    std::uint64_t make_handle() { return *live_.insert(++last_).first; }
    [[nodiscard]] bool lives(std::uint64_t handle) const { return live_.contains(handle); }
    void end(std::uint64_t handle) { live_.erase(handle); }
    /// None: it is to do its work.
    XrResult failure_of(const char* function);
    XrPath path_of(const std::string& text);
    [[nodiscard]] bool is_of_eyes(XrPath path) const;
    void see_eyes() { saw_eyes_ = true; }

  private:
    static PFN_xrVoidFunction find_through_layer(XrInstance instance, const char* name);

    std::uint64_t last_ = 1000;
    std::set<std::uint64_t> live_;
    std::map<std::string, XrPath> paths_;
    std::map<std::string, XrResult, std::less<>> failures_;
    bool saw_eyes_ = false;
    bool focused_ = true;
};

}  // namespace gazeloop::openxr_layer
