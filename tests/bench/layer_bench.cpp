#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

#include "runtime/openxr/instance.h"
#include "runtime/openxr/session.h"
#include "runtime/openxr/vulkan_objects.h"
#include "runtime/openxr/xr_clock.h"
#include "runtime/openxr_layer/instance_creation.h"
#include "runtime/openxr_layer/next_functions.h"
#include "runtime/present/openxr/openxr_swapchain.h"
#include "runtime/time/clock.h"
#include "tests/bench/bench.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/layer_in_process.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::bench {
namespace {

using openxr::typed;
using openxr::xr_check;

constexpr const char* kBench = "layer";
constexpr std::size_t kWarmUp = 120;
/// With the layer and without it, by each clock.
constexpr std::size_t kPairs = 600;
constexpr double kRefreshHz = 200.0;

/// By which clock a frame is measured: the host's, or that of its thread, which stands still while
/// another one has the processor.
enum class By : std::uint8_t { Wall, Thread };
By g_by = By::Wall;

/// What calls have cost: of this thread, since it began.
struct Cost {
    std::int64_t ns = 0;
    std::int64_t allocations = 0;
    std::int64_t readings = 0;  ///< of the clock

    friend Cost operator-(const Cost& a, const Cost& b) {
        return {a.ns - b.ns, a.allocations - b.allocations, a.readings - b.readings};
    }
    Cost& operator+=(const Cost& more) {
        ns += more.ns;
        allocations += more.allocations;
        readings += more.readings;
        return *this;
    }
};

Cost now() {
    static std::int64_t readings = 0;
    timespec time{};
    clock_gettime(g_by == By::Wall ? CLOCK_MONOTONIC : CLOCK_THREAD_CPUTIME_ID, &time);
    return {std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec,
            static_cast<std::int64_t>(tests::allocations_of_this_thread()), ++readings};
}

/// What one reading of the clock in use costs, which is the bench's and not the layer's: a thread's
/// clock is a system call.
double reading_ns() {
    static std::array<std::optional<double>, 2> known;
    auto& cost = known[static_cast<std::size_t>(g_by)];
    if (!cost) {
        std::vector<double> steps(1001);
        for (double& step : steps) {
            const Cost before = now();
            step = static_cast<double>((now() - before).ns);
        }
        cost = median(steps);
    }
    return *cost;
}

double us(const Cost& cost) {
    return (static_cast<double>(cost.ns) - static_cast<double>(cost.readings) * reading_ns()) *
           1e-3;
}

constexpr std::array<std::string_view, 7> kCalls{
    "xrWaitFrame",   "xrBeginFrame",  "xrSyncActions", "xrGetActionStatePose",
    "xrLocateSpace", "xrLocateViews", "xrEndFrame"};

/// What was spent below the layer, in calls that the application would have made without it.
Cost g_below;
/// And in those that the layer makes to locate the head, as a runtime with eyes would itself.
Cost g_locating_head;

/// A call below the layer, watched. `kSlot` tells functions of one type apart.
template <int kSlot, Cost& kSum, typename Function>
struct Watched;
template <int kSlot, Cost& kSum, typename... Arguments>
struct Watched<kSlot, kSum, XrResult(XRAPI_PTR*)(Arguments...)> {
    static inline XrResult(XRAPI_PTR* next)(Arguments...) = nullptr;
    static XRAPI_ATTR XrResult XRAPI_CALL call(Arguments... arguments) {
        const Cost before = now();
        const XrResult result = next(arguments...);
        kSum += now() - before;
        return result;
    }
};

/// The functions of a frame: an application's that reads gaze.
struct Calls {
    PFN_xrSyncActions sync;
    PFN_xrGetActionStatePose get_state;
    PFN_xrWaitFrame wait;
    PFN_xrBeginFrame begin;
    PFN_xrLocateViews locate_views;
    PFN_xrLocateSpace locate_space;
    PFN_xrEndFrame end;

    static Calls of(PFN_xrGetInstanceProcAddr get, XrInstance instance) {
        const auto find = [&]<typename Function>(Function& function, const char* name) {
            function = openxr_layer::function_of<Function>(get, instance, name);
        };
        Calls calls{};
        find(calls.sync, "xrSyncActions");
        find(calls.get_state, "xrGetActionStatePose");
        find(calls.wait, "xrWaitFrame");
        find(calls.begin, "xrBeginFrame");
        find(calls.locate_views, "xrLocateViews");
        find(calls.locate_space, "xrLocateSpace");
        find(calls.end, "xrEndFrame");
        return calls;
    }
};

/// The runtime's, made before the layer: they are handed to it as if they were new.
XrInstance g_instance = XR_NULL_HANDLE;
XrSession g_session = XR_NULL_HANDLE;

XRAPI_ATTR XrResult XRAPI_CALL made_session(XrInstance, const XrSessionCreateInfo*,
                                            XrSession* session) {
    *session = g_session;
    return XR_SUCCESS;
}
XRAPI_ATTR XrResult XRAPI_CALL keep_session(XrSession) { return XR_SUCCESS; }
XRAPI_ATTR XrResult XRAPI_CALL keep_instance(XrInstance) { return XR_SUCCESS; }

template <int kSlot, typename Function, Cost& kSum = g_below>
PFN_xrVoidFunction watched(XrInstance instance, const char* name) {
    Watched<kSlot, kSum, Function>::next =
        openxr_layer::function_of<Function>(&xrGetInstanceProcAddr, instance, name);
    return reinterpret_cast<PFN_xrVoidFunction>(&Watched<kSlot, kSum, Function>::call);
}

/// Below the layer: the loader, above Monado.
XRAPI_ATTR XrResult XRAPI_CALL below(XrInstance instance, const char* name,
                                     PFN_xrVoidFunction* function) {
    const std::string_view text = name;
    const auto give = [&](auto* own) {
        *function = reinterpret_cast<PFN_xrVoidFunction>(own);
        return XR_SUCCESS;
    };
    if (text == "xrCreateSession") {
        return give(&made_session);
    }
    if (text == "xrDestroySession") {
        return give(&keep_session);
    }
    if (text == "xrDestroyInstance") {
        return give(&keep_instance);
    }
    if (text == "xrSyncActions") {
        *function = watched<0, PFN_xrSyncActions>(instance, name);
    } else if (text == "xrGetActionStatePose") {
        *function = watched<1, PFN_xrGetActionStatePose>(instance, name);
    } else if (text == "xrWaitFrame") {
        *function = watched<2, PFN_xrWaitFrame>(instance, name);
    } else if (text == "xrBeginFrame") {
        *function = watched<3, PFN_xrBeginFrame>(instance, name);
    } else if (text == "xrLocateViews") {
        *function = watched<4, PFN_xrLocateViews>(instance, name);
    } else if (text == "xrEndFrame") {
        *function = watched<5, PFN_xrEndFrame>(instance, name);
    } else if (text == "xrLocateSpace") {
        *function = watched<6, PFN_xrLocateSpace, g_locating_head>(instance, name);
    } else {
        return xrGetInstanceProcAddr(instance, name, function);
    }
    return XR_SUCCESS;
}

struct Case {
    const char* name;
    const char* gaze;
    bool records;
};

/// Files of the layer go into a folder of their own.
struct Home {
    explicit Home(const Case& at) {
        for (const char* const name : {"XDG_CONFIG_HOME", "XDG_STATE_HOME", "XDG_DATA_HOME"}) {
            setenv(name, folder.path().c_str(), 1);
        }
        std::string lines = std::string("sim.rate_hz=200\nlayer.gaze=") + at.gaze;
        if (at.records) {
            lines += "\nlayer.record=" + (folder / "session.gaze").string();
        }
        setenv("GAZELOOP_LAYER_SETTINGS", lines.c_str(), 1);
    }
    tests::TemporaryFolder folder;
};

/// An application that reads gaze, with a session on the null compositor. Its calls go through the
/// layer or past it.
class Application {
  public:
    Application()
        : choice_(openxr::choose_runtime(display())),
          instance_(choice_,
                    {.validation = false, .wanted = {XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME}}),
          clock_(instance_),
          vulkan_(instance_),
          context_({}, &vulkan_),
          session_(instance_, clock_, context_) {
        g_instance = instance_.handle();
        g_session = session_.handle();
        tests::put_layer_above(
            g_instance, {.extensions = {XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME}}, &below);
        past_ = Calls::of(&xrGetInstanceProcAddr, g_instance);
        through_ = Calls::of(&openxr_layer::get_instance_proc_addr, g_instance);
        make_actions();
        while (session_.poll() == openxr::Session::Activity::Idle) {
        }
        for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
            swapchains_.emplace_back(context_, g_session, vk::Extent2D{64, 64},
                                     vk::Format::eR8G8B8A8Srgb, present::SwapchainContent::Color);
        }
    }
    Application(const Application&) = delete;
    Application& operator=(const Application&) = delete;
    ~Application() {
        layer<PFN_xrDestroySession>("xrDestroySession")(g_session);
        layer<PFN_xrDestroyInstance>("xrDestroyInstance")(g_instance);
    }

    /// What one frame's calls cost the application, without the runtime's wait for its time.
    struct Spent {
        Cost all;
        Cost below;  ///< of it in calls that it would have made anyway
        Cost locating_space;
        Cost locating_head;                          ///< of the layer's own
        std::array<double, kCalls.size()> own_us{};  ///< by call: all less below
    };
    Spent frame(bool through_layer) {
        if (session_.poll() == openxr::Session::Activity::Ended) {
            throw std::runtime_error("the runtime has ended the session");
        }
        const Calls& calls = through_layer ? through_ : past_;
        Spent spent;
        g_below = g_locating_head = {};
        Cost waiting;
        auto state = typed<XrFrameState>(XR_TYPE_FRAME_STATE);
        const auto wait = typed<XrFrameWaitInfo>(XR_TYPE_FRAME_WAIT_INFO);
        const auto timed = [&](std::string_view name, auto&& call) {
            const Cost below = g_below;
            const Cost before = now();
            const XrResult result = call();
            const Cost cost = now() - before;
            spent.all += cost;
            spent.own_us[static_cast<std::size_t>(std::ranges::find(kCalls, name) -
                                                  kCalls.begin())] = us(cost - (g_below - below));
            xr_check(result, name);
            return cost;
        };
        waiting = timed("xrWaitFrame", [&] { return calls.wait(g_session, &wait, &state); });
        if (through_layer) {
            waiting = g_below;
        }
        for (present::OpenXrSwapchain& swapchain : swapchains_) {
            swapchain.acquire();
            swapchain.release();
        }
        const auto begin = typed<XrFrameBeginInfo>(XR_TYPE_FRAME_BEGIN_INFO);
        timed("xrBeginFrame", [&] { return calls.begin(g_session, &begin); });
        const XrActiveActionSet active{set_, XR_NULL_PATH};
        auto sync = typed<XrActionsSyncInfo>(XR_TYPE_ACTIONS_SYNC_INFO);
        sync.countActiveActionSets = 1;
        sync.activeActionSets = &active;
        timed("xrSyncActions", [&] { return calls.sync(g_session, &sync); });
        auto get = typed<XrActionStateGetInfo>(XR_TYPE_ACTION_STATE_GET_INFO);
        get.action = action_;
        auto pose = typed<XrActionStatePose>(XR_TYPE_ACTION_STATE_POSE);
        timed("xrGetActionStatePose", [&] { return calls.get_state(g_session, &get, &pose); });
        gaze_is_active_ = pose.isActive == XR_TRUE;
        auto location = typed<XrSpaceLocation>(XR_TYPE_SPACE_LOCATION);
        spent.locating_space = timed("xrLocateSpace", [&] {
            return calls.locate_space(gaze_, session_.local_space(), state.predictedDisplayTime,
                                      &location);
        });
        std::array views{typed<XrView>(XR_TYPE_VIEW), typed<XrView>(XR_TYPE_VIEW)};
        locate_views(timed, calls, state.predictedDisplayTime, views);
        end(timed, calls, state.predictedDisplayTime, views);
        spent.all = spent.all - waiting;
        spent.below = through_layer ? g_below - waiting : spent.all;
        spent.locating_head = g_locating_head;
        return spent;
    }
    [[nodiscard]] bool gaze_is_active() const { return gaze_is_active_; }
    [[nodiscard]] bool has_focus() const { return session_.state() == XR_SESSION_STATE_FOCUSED; }

  private:
    static display::DisplayProfile display() {
        display::DisplayProfile display;
        display.width_px = display.height_px = 64;
        display.refresh_hz = kRefreshHz;
        constexpr double kHalf_rad = 0.8;
        display.fov.fill({-kHalf_rad, kHalf_rad, kHalf_rad, -kHalf_rad});
        return display;
    }

    template <typename Function>
    Function layer(const char* name) const {
        return openxr_layer::function_of<Function>(&openxr_layer::get_instance_proc_addr,
                                                   g_instance, name);
    }
    XrPath path(const char* text) const {
        XrPath path = XR_NULL_PATH;
        xr_check(xrStringToPath(g_instance, text, &path), text);
        return path;
    }

    void make_actions() {
        const auto create = typed<XrSessionCreateInfo>(XR_TYPE_SESSION_CREATE_INFO);
        XrSession session = XR_NULL_HANDLE;
        xr_check(layer<PFN_xrCreateSession>("xrCreateSession")(g_instance, &create, &session),
                 "the layer's session");
        auto set = typed<XrActionSetCreateInfo>(XR_TYPE_ACTION_SET_CREATE_INFO);
        std::strcpy(set.actionSetName, "eyes");
        std::strcpy(set.localizedActionSetName, "eyes");
        xr_check(layer<PFN_xrCreateActionSet>("xrCreateActionSet")(g_instance, &set, &set_),
                 "xrCreateActionSet");
        auto action = typed<XrActionCreateInfo>(XR_TYPE_ACTION_CREATE_INFO);
        std::strcpy(action.actionName, "gaze");
        std::strcpy(action.localizedActionName, "gaze");
        action.actionType = XR_ACTION_TYPE_POSE_INPUT;
        xr_check(layer<PFN_xrCreateAction>("xrCreateAction")(set_, &action, &action_),
                 "xrCreateAction");
        const XrActionSuggestedBinding binding{action_, path("/user/eyes_ext/input/gaze_ext/pose")};
        auto suggested = typed<XrInteractionProfileSuggestedBinding>(
            XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING);
        suggested.interactionProfile = path("/interaction_profiles/ext/eye_gaze_interaction");
        suggested.countSuggestedBindings = 1;
        suggested.suggestedBindings = &binding;
        xr_check(layer<PFN_xrSuggestInteractionProfileBindings>(
                     "xrSuggestInteractionProfileBindings")(g_instance, &suggested),
                 "xrSuggestInteractionProfileBindings");
        auto attach = typed<XrSessionActionSetsAttachInfo>(XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO);
        attach.countActionSets = 1;
        attach.actionSets = &set_;
        xr_check(
            layer<PFN_xrAttachSessionActionSets>("xrAttachSessionActionSets")(g_session, &attach),
            "xrAttachSessionActionSets");
        auto space = typed<XrActionSpaceCreateInfo>(XR_TYPE_ACTION_SPACE_CREATE_INFO);
        space.action = action_;
        space.poseInActionSpace = openxr::to_xr({});
        xr_check(layer<PFN_xrCreateActionSpace>("xrCreateActionSpace")(g_session, &space, &gaze_),
                 "xrCreateActionSpace");
    }

    template <typename Timed, typename Views>
    void locate_views(const Timed& timed, const Calls& calls, XrTime display, Views& views) {
        auto info = typed<XrViewLocateInfo>(XR_TYPE_VIEW_LOCATE_INFO);
        info.viewConfigurationType = openxr::kStereo;
        info.displayTime = display;
        info.space = session_.local_space();
        auto state = typed<XrViewState>(XR_TYPE_VIEW_STATE);
        std::uint32_t count = 0;
        timed("xrLocateViews", [&] {
            return calls.locate_views(g_session, &info, &state,
                                      static_cast<std::uint32_t>(views.size()), &count,
                                      views.data());
        });
    }
    template <typename Timed, typename Views>
    void end(const Timed& timed, const Calls& calls, XrTime display, const Views& views) {
        std::array<XrCompositionLayerProjectionView, gaze::kEyeCount> pictures{};
        for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
            pictures[eye] = {XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW, nullptr, views[eye].pose,
                             views[eye].fov, swapchains_[eye].sub_image()};
        }
        auto projection = typed<XrCompositionLayerProjection>(XR_TYPE_COMPOSITION_LAYER_PROJECTION);
        projection.space = session_.local_space();
        projection.viewCount = static_cast<std::uint32_t>(pictures.size());
        projection.views = pictures.data();
        const auto* const layer =
            reinterpret_cast<const XrCompositionLayerBaseHeader*>(&projection);
        auto info = typed<XrFrameEndInfo>(XR_TYPE_FRAME_END_INFO);
        info.displayTime = display;
        info.environmentBlendMode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
        info.layerCount = 1;
        info.layers = &layer;
        timed("xrEndFrame", [&] { return calls.end(g_session, &info); });
    }

    openxr::RuntimeChoice choice_;
    openxr::Instance instance_;
    openxr::XrClock clock_;
    openxr::VulkanObjects vulkan_;
    vulkan::Context context_;
    openxr::Session session_;
    Calls past_{};
    Calls through_{};
    XrActionSet set_ = XR_NULL_HANDLE;
    XrAction action_ = XR_NULL_HANDLE;
    XrSpace gaze_ = XR_NULL_HANDLE;
    std::vector<present::OpenXrSwapchain> swapchains_;
    bool gaze_is_active_ = false;
};

double percentile(std::vector<double> values, double share) {
    std::ranges::sort(values);
    const auto rank =
        static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
    return values[std::max<std::size_t>(rank, 1) - 1];
}

/// What frames cost by one clock.
struct Measured {
    std::vector<double> with_us;
    std::vector<double> without_us;
    std::vector<double> own_us;
    std::vector<double> locating_head_us;
    std::array<std::vector<double>, kCalls.size()> by_call_us;
};

/// The frames of one session, by one clock.
struct Frames {
    std::vector<Application::Spent> with;
    std::vector<Application::Spent> without;

    void add_to(Measured& measured) const {
        std::vector<double> locate_us;
        for (const Application::Spent& spent : without) {
            measured.without_us.push_back(us(spent.all));
            locate_us.push_back(us(spent.locating_space));
        }
        // The layer locates in its own way: what it does not have to call counts for it.
        const double usual_locate_us = median(locate_us);
        for (const Application::Spent& spent : with) {
            measured.with_us.push_back(us(spent.all));
            for (std::size_t call = 0; call < kCalls.size(); ++call) {
                const bool locates = kCalls[call] == "xrLocateSpace";
                measured.by_call_us[call].push_back(spent.own_us[call] -
                                                    (locates ? usual_locate_us : 0.0));
            }
            measured.own_us.push_back(us(spent.all - spent.below) - usual_locate_us);
            measured.locating_head_us.push_back(us(spent.locating_head));
        }
    }
};

void add_case(const Case& at, const Options& options, std::vector<Figure>& figures) {
    std::array<Measured, 2> measured;
    std::int64_t most_allocations = 0;
    for (unsigned round = 0; round < options.rounds; ++round) {
        const Home home(at);
        Application application;
        std::array<Frames, 2> frames;
        for (std::size_t frame = 0; frame < kWarmUp + 4 * kPairs; ++frame) {
            const bool through = frame % 2 == 0;
            const std::size_t clock = frame / 2 % 2;
            g_by = static_cast<By>(clock);
            const Application::Spent spent = application.frame(through);
            if (frame < kWarmUp) {
                continue;
            }
            (through ? frames[clock].with : frames[clock].without).push_back(spent);
            if (through) {
                most_allocations =
                    std::max(most_allocations, spent.all.allocations - spent.below.allocations);
            }
        }
        for (std::size_t clock = 0; clock < frames.size(); ++clock) {
            g_by = static_cast<By>(clock);
            frames[clock].add_to(measured[clock]);
        }
    }
    const auto add = [&](const std::string& metric, double value, const char* unit,
                         std::optional<double> target) {
        figures.push_back({kBench, at.name, metric, value, unit, "lower", std::nullopt, target});
    };
    const auto& [by_wall, by_thread] = measured;
    add("a frame without it, p50", percentile(by_wall.without_us, 0.5), "us", std::nullopt);
    add("a frame without it, p99", percentile(by_wall.without_us, 0.99), "us", std::nullopt);
    add("a frame with it, p50", percentile(by_wall.with_us, 0.5), "us", std::nullopt);
    add("a frame with it, p99", percentile(by_wall.with_us, 0.99), "us", std::nullopt);
    add("the layer's own, p50", percentile(by_wall.own_us, 0.5), "us", std::nullopt);
    add("the layer's own, p99", percentile(by_wall.own_us, 0.99), "us", 30.0);
    add("processor time without it, p50", percentile(by_thread.without_us, 0.5), "us",
        std::nullopt);
    add("processor time, its own, p50", percentile(by_thread.own_us, 0.5), "us", std::nullopt);
    add("processor time, its own, p99", percentile(by_thread.own_us, 0.99), "us", 30.0);
    add("of it the runtime's, to locate the head, p50", percentile(by_thread.locating_head_us, 0.5),
        "us", std::nullopt);
    for (std::size_t call = 0; call < kCalls.size(); ++call) {
        add("own in " + std::string(kCalls[call]) + ", p50",
            percentile(by_thread.by_call_us[call], 0.5), "us", std::nullopt);
    }
    add("most allocations a frame", static_cast<double>(most_allocations), "", 0.0);
}

}  // namespace

std::vector<Figure> layer(const Options& options) {
    // The last two have threads of the layer's beside the application's.
    constexpr std::array kCases{Case{"gaze", "fixed:3,4", false},
                                Case{"gaze, recorded", "fixed:3,4", true},
                                Case{"simulated gaze", "sim", false}};
    std::vector<Figure> figures;
    for (const Case& at : kCases) {
        if (options.wants(at.name)) {
            add_case(at, options, figures);
        }
    }
    return figures;
}

}  // namespace gazeloop::bench
