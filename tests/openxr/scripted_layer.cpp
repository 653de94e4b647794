// An OpenXR API layer that stands between gazeloop and the runtime and does what Monado cannot be
// made to do. GAZELOOP_TEST_SCRIPT says what happens at the 10th frame:
//   exit        the runtime ends the session
//   loss        the runtime says that it is about to lose the session
//   mask        the left half of both views becomes hidden; before, the corners are
//   no-mask     nothing is hidden any more; before, the corners are
//   odd-mask    the mask is no list of triangles from the beginning on
#define XR_USE_GRAPHICS_API_VULKAN
#include <vulkan/vulkan.h>
// After what it needs.
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

#include <cstdlib>
#include <cstring>
#include <optional>
#include <string_view>
#include <vector>

namespace {

// The loader's interface for layers, version 1 (openxr_loader_negotiation.h, which Debian 12
// lacks).
enum class Kind : std::uint32_t { LoaderInfo = 1, LayerRequest, RuntimeRequest, Create, Next };

struct NextInfo {
    Kind kind;
    std::uint32_t version;
    std::size_t size;
    char layer_name[XR_MAX_API_LAYER_NAME_SIZE];
    PFN_xrGetInstanceProcAddr next_get_proc;
    XrResult(XRAPI_PTR* next_create)(const XrInstanceCreateInfo*, const struct CreateInfo*,
                                     XrInstance*);
    NextInfo* next;
};
struct CreateInfo {
    Kind kind;
    std::uint32_t version;
    std::size_t size;
    void* loader_instance;
    char settings_file[512];
    NextInfo* next_info;
};
struct LayerRequest {
    Kind kind;
    std::uint32_t version;
    std::size_t size;
    std::uint32_t interface_version;
    XrVersion api_version;
    PFN_xrGetInstanceProcAddr get_proc;
    XrResult(XRAPI_PTR* create)(const XrInstanceCreateInfo*, const CreateInfo*, XrInstance*);
};

constexpr int kFrame = 10;

PFN_xrGetInstanceProcAddr g_next = nullptr;
XrInstance g_instance = XR_NULL_HANDLE;
XrSession g_session = XR_NULL_HANDLE;
int g_frames = 0;
bool g_told = false;

std::string_view script() {
    const char* const text = std::getenv("GAZELOOP_TEST_SCRIPT");
    return text != nullptr ? text : "";
}

template <typename Function>
Function next(const char* name) {
    PFN_xrVoidFunction function = nullptr;
    g_next(g_instance, name, &function);
    return reinterpret_cast<Function>(function);
}

XrResult XRAPI_CALL create_session(XrInstance instance, const XrSessionCreateInfo* info,
                                   XrSession* session) {
    const XrResult result = next<PFN_xrCreateSession>("xrCreateSession")(instance, info, session);
    g_session = *session;
    return result;
}

XrResult XRAPI_CALL wait_frame(XrSession session, const XrFrameWaitInfo* info,
                               XrFrameState* state) {
    if (++g_frames == kFrame && script() == "exit") {
        next<PFN_xrRequestExitSession>("xrRequestExitSession")(session);
    }
    return next<PFN_xrWaitFrame>("xrWaitFrame")(session, info, state);
}

XrResult XRAPI_CALL poll_event(XrInstance instance, XrEventDataBuffer* event) {
    if (g_frames >= kFrame && !g_told) {
        g_told = true;
        if (script() == "loss") {
            const XrEventDataSessionStateChanged lost{XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED,
                                                      nullptr, g_session,
                                                      XR_SESSION_STATE_LOSS_PENDING, 1};
            std::memcpy(event, &lost, sizeof lost);
            return XR_SUCCESS;
        }
        if (script() == "mask" || script() == "no-mask") {
            const XrEventDataVisibilityMaskChangedKHR changed{
                XR_TYPE_EVENT_DATA_VISIBILITY_MASK_CHANGED_KHR, nullptr, g_session,
                XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, 0};
            std::memcpy(event, &changed, sizeof changed);
            return XR_SUCCESS;
        }
    }
    return next<PFN_xrPollEvent>("xrPollEvent")(instance, event);
}

XrResult give(const std::vector<XrVector2f>& vertices, const std::vector<std::uint32_t>& indices,
              XrVisibilityMaskKHR* mask) {
    mask->vertexCountOutput = static_cast<std::uint32_t>(vertices.size());
    mask->indexCountOutput = static_cast<std::uint32_t>(indices.size());
    if (mask->vertexCapacityInput >= vertices.size() &&
        mask->indexCapacityInput >= indices.size()) {
        std::copy(vertices.begin(), vertices.end(), mask->vertices);
        std::copy(indices.begin(), indices.end(), mask->indices);
    }
    return XR_SUCCESS;
}

XrResult XRAPI_CALL get_visibility_mask(XrSession session, XrViewConfigurationType configuration,
                                        std::uint32_t view, XrVisibilityMaskTypeKHR type,
                                        XrVisibilityMaskKHR* mask) {
    if (script() == "odd-mask") {
        return give({{-1, -1}, {0, -1}, {0, 1}}, {0, 1, 9}, mask);
    }
    if (script() == "mask" && g_told) {
        return give({{-9, -9}, {0, -9}, {0, 9}, {-9, 9}}, {0, 1, 2, 0, 2, 3}, mask);
    }
    if (script() == "no-mask" && g_told) {
        return give({}, {}, mask);
    }
    return next<PFN_xrGetVisibilityMaskKHR>("xrGetVisibilityMaskKHR")(session, configuration, view,
                                                                      type, mask);
}

XrResult XRAPI_CALL get_proc(XrInstance instance, const char* name, PFN_xrVoidFunction* function) {
    const std::string_view wanted = name;
    if (wanted == "xrCreateSession") {
        *function = reinterpret_cast<PFN_xrVoidFunction>(create_session);
    } else if (wanted == "xrWaitFrame") {
        *function = reinterpret_cast<PFN_xrVoidFunction>(wait_frame);
    } else if (wanted == "xrPollEvent") {
        *function = reinterpret_cast<PFN_xrVoidFunction>(poll_event);
    } else if (wanted == "xrGetVisibilityMaskKHR") {
        *function = reinterpret_cast<PFN_xrVoidFunction>(get_visibility_mask);
    } else {
        return g_next(instance, name, function);
    }
    return XR_SUCCESS;
}

XrResult XRAPI_CALL create(const XrInstanceCreateInfo* info, const CreateInfo* layer,
                           XrInstance* instance) {
    CreateInfo below = *layer;
    below.next_info = layer->next_info->next;
    g_next = layer->next_info->next_get_proc;
    const XrResult result = layer->next_info->next_create(info, &below, instance);
    g_instance = *instance;
    return result;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) XrResult XRAPI_CALL
xrNegotiateLoaderApiLayerInterface(const void* /*loader*/, const char* /*name*/,
                                   LayerRequest* request) {
    request->interface_version = 1;
    request->api_version = XR_MAKE_VERSION(1, 0, 0);
    request->get_proc = get_proc;
    request->create = create;
    return XR_SUCCESS;
}
