#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "runtime/openxr/xr_check.h"
#include "runtime/openxr_layer/instance_creation.h"
#include "runtime/openxr_layer/loader_interface.h"

namespace gazeloop::openxr_layer {

/// An OpenXR runtime without eyes, display or loader, below the layer in this process. It knows no
/// eye gaze, gives the handles that are asked for, refuses handles that it did not give, and its
/// head turns steadily. Its OpenXR functions may be called by several threads.
class MockRuntime {
  public:
    static MockRuntime& the();

    /// The next call of a function of that name fails.
    void fail_next(const std::string& function, XrResult result) { failures_[function] = result; }

    /// The layer's two functions: those of this program, or of a library that was loaded.
    struct Layer {
        PFN_xrCreateApiLayerInstance create_instance = &openxr_layer::create_instance;
        PFN_xrGetInstanceProcAddr get_instance_proc_addr = &openxr_layer::get_instance_proc_addr;
    };
    void set_layer(const Layer& layer) { layer_ = layer; }

    /// From now on it has no more than the core of OpenXR 1.0, lists nothing to who has no
    /// instance, and converts no times.
    void set_oldest(bool oldest) { oldest_ = oldest; }
    [[nodiscard]] bool oldest() const { return oldest_; }

    /// An instance through the layer, with these extensions; its functions by their names.
    XrResult create_through_layer(const std::vector<const char*>& extensions, XrInstance& instance);
    template <typename Function>
    [[nodiscard]] static Function through_layer(XrInstance instance, const char* name) {
        return reinterpret_cast<Function>(find_through_layer(instance, name));
    }

    [[nodiscard]] static XrTime now();
    /// Paths and extensions that only the layer should know came through to here.
    [[nodiscard]] bool saw_eyes() const { return saw_eyes_; }
    /// Images of all swapchains that are acquired and not released.
    [[nodiscard]] std::uint32_t acquired_images() const;
    /// Of the projection layers of the frame that ended last.
    [[nodiscard]] const std::vector<std::uint32_t>& view_counts() const { return view_counts_; }
    [[nodiscard]] bool focused() const { return focused_; }
    void set_focused(bool focused) { focused_ = focused; }

    // What the functions below use, under the mutex.

    [[nodiscard]] std::mutex& mutex() { return mutex_; }
    std::uint64_t make_handle() { return *live_.insert(++last_).first; }
    void add_instance() { ++instances_; }
    /// With the last of them all that was made ends.
    void end_instance(std::uint64_t handle);
    [[nodiscard]] bool lives(std::uint64_t handle) const { return live_.contains(handle); }
    void end(std::uint64_t handle) { live_.erase(handle); }
    /// None: it is to do its work.
    XrResult failure_of(const char* function);
    XrPath path_of(const std::string& text);
    [[nodiscard]] bool is_of_eyes(XrPath path) const;
    void see_eyes() { saw_eyes_ = true; }
    // As the specification orders them, each swapchain with kImages images.
    XrResult acquire(std::uint64_t swapchain, std::uint32_t& index);
    XrResult wait(std::uint64_t swapchain);
    XrResult release(std::uint64_t swapchain);
    void see_layers(const XrFrameEndInfo& info);

  private:
    static constexpr std::uint32_t kImages = 3;
    struct Acquired {
        std::uint32_t next = 0;
        std::uint32_t images = 0;
        bool waited = false;
    };

    static PFN_xrVoidFunction find_through_layer(XrInstance instance, const char* name);

    std::mutex mutex_;
    Layer layer_;
    bool oldest_ = false;

    std::uint64_t last_ = 1000;
    std::uint64_t instances_ = 0;
    std::set<std::uint64_t> live_;
    std::map<std::uint64_t, Acquired> acquired_;
    std::vector<std::uint32_t> view_counts_;
    std::map<std::string, XrPath> paths_;
    std::map<std::string, XrResult, std::less<>> failures_;
    bool saw_eyes_ = false;
    bool focused_ = true;
};

}  // namespace gazeloop::openxr_layer
