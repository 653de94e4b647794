#!/usr/bin/env bash
# OpenXR's core validation layer 1.0.20 (Debian 12's openxr-layer-corevalidation): a valid call with two
# structures in one chain fails, and never reaches the runtime.
#
# Located gaze can be asked for its sample time (XrEyeGazeSampleTimeEXT) and, as any space, for its velocity
# (XrSpaceVelocity). Both extend XrSpaceLocation, and a chain may hold several, in any order. The layer takes
# either alone. Of two it takes the second for an extension of the first, where it allows none:
# xrLocateSpace returns XR_ERROR_VALIDATION_FAILURE (-1), so with validation on there is no gaze at all.
# The same happens to xrGetSystemProperties asked for eye gaze and hand tracking at once. A structure that
# it does not know fails as well, which a runtime has to pass over: extensions that are newer than the layer.
# The messages name the application's structures as invalid, so it is the application that is searched.
# Ask one structure a call where this layer may be on, or judge the chain by a newer layer.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
cd -- "$folder"
apt-get download -q openxr-layer-corevalidation=1.0.20~dfsg1-1+b2 libopenxr-loader1=1.0.20~dfsg1-1+b2 \
    libopenxr-dev=1.0.20~dfsg1-1+b2 libjsoncpp25=1.9.5-4 >/dev/null 2>&1
for package in ./*.deb; do
    dpkg-deb -x "$package" root
done
library=$folder/root/usr/lib/x86_64-linux-gnu
export LD_LIBRARY_PATH=$library
unset XR_ENABLE_API_LAYERS
export XR_API_LAYER_PATH=$folder/layers
export XR_RUNTIME_JSON=$folder/runtime.json
export XR_CORE_VALIDATION_EXPORT_TYPE=text
export XR_CORE_VALIDATION_FILE_NAME=$folder/said.txt
mkdir layers
sed "s|/usr/lib|$folder/root/usr/lib|" \
    root/usr/share/openxr/1/api_layers/explicit.d/XrApiLayer_core_validation*.json >layers/layer.json
printf '{"file_format_version": "1.0.0", "runtime": {"library_path": "%s"}}\n' \
    "$folder/libruntime.so" >runtime.json

# A runtime that does what these calls need, and fills every structure of a chain that it knows.
cat >runtime.cpp <<'CODE'
#include <cstdint>
#include <cstring>
#include <openxr/openxr.h>

namespace {

// The loader's interface (openxr_loader_negotiation.h, which the package lacks).
struct LoaderInfo;
struct RuntimeRequest {
    int type;
    std::uint32_t version;
    std::size_t size;
    std::uint32_t interface_version;
    XrVersion api_version;
    PFN_xrGetInstanceProcAddr get_instance_proc_addr;
};

constexpr const char* kExtensions[] = {"XR_MND_headless", "XR_EXT_eye_gaze_interaction",
                                       "XR_EXT_hand_tracking"};
std::uint64_t last_handle = 0;

template <typename Handle>
XrResult create(Handle* handle) {
    *handle = reinterpret_cast<Handle>(++last_handle);
    return XR_SUCCESS;
}

XrResult extensions(const char*, std::uint32_t capacity, std::uint32_t* count,
                    XrExtensionProperties* properties) {
    *count = 3;
    for (std::uint32_t i = 0; i < 3 && capacity != 0; ++i) {
        std::strcpy(properties[i].extensionName, kExtensions[i]);
        properties[i].extensionVersion = 1;
    }
    return XR_SUCCESS;
}

XrResult create_instance(const XrInstanceCreateInfo*, XrInstance* made) { return create(made); }
XrResult create_session(XrInstance, const XrSessionCreateInfo*, XrSession* made) { return create(made); }
XrResult create_space(XrSession, const XrReferenceSpaceCreateInfo*, XrSpace* made) { return create(made); }
XrResult destroy(XrInstance) { return XR_SUCCESS; }

XrResult get_system(XrInstance, const XrSystemGetInfo*, XrSystemId* system) {
    *system = 1;
    return XR_SUCCESS;
}

XrResult system_properties(XrInstance, XrSystemId system, XrSystemProperties* properties) {
    properties->systemId = system;
    return XR_SUCCESS;
}

XrResult locate(XrSpace, XrSpace, XrTime time, XrSpaceLocation* location) {
    location->locationFlags = 0xF;
    location->pose.orientation.w = 1;
    for (auto* next = static_cast<XrBaseOutStructure*>(location->next); next != nullptr; next = next->next) {
        if (next->type == XR_TYPE_SPACE_VELOCITY) {
            reinterpret_cast<XrSpaceVelocity*>(next)->velocityFlags = 0x3;
        } else if (next->type == XR_TYPE_EYE_GAZE_SAMPLE_TIME_EXT) {
            reinterpret_cast<XrEyeGazeSampleTimeEXT*>(next)->time = time;
        }
    }
    return XR_SUCCESS;
}

XrResult get_instance_proc_addr(XrInstance, const char* name, PFN_xrVoidFunction* function) {
    const struct {
        const char* name;
        void* function;
    } functions[] = {{"xrGetInstanceProcAddr", (void*)get_instance_proc_addr},
                     {"xrEnumerateInstanceExtensionProperties", (void*)extensions},
                     {"xrCreateInstance", (void*)create_instance},
                     {"xrDestroyInstance", (void*)destroy},
                     {"xrGetSystem", (void*)get_system},
                     {"xrGetSystemProperties", (void*)system_properties},
                     {"xrCreateSession", (void*)create_session},
                     {"xrCreateReferenceSpace", (void*)create_space},
                     {"xrLocateSpace", (void*)locate}};
    for (const auto& each : functions) {
        if (std::strcmp(name, each.name) == 0) {
            *function = reinterpret_cast<PFN_xrVoidFunction>(each.function);
            return XR_SUCCESS;
        }
    }
    *function = nullptr;
    return XR_ERROR_FUNCTION_UNSUPPORTED;
}

}  // namespace

extern "C" XrResult xrNegotiateLoaderRuntimeInterface(const LoaderInfo*, RuntimeRequest* request) {
    request->interface_version = 1;
    request->api_version = XR_CURRENT_API_VERSION;
    request->get_instance_proc_addr = get_instance_proc_addr;
    return XR_SUCCESS;
}
CODE

# With the layer if there is an argument: results of the calls, and whether what they ask for came back.
cat >application.cpp <<'CODE'
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <openxr/openxr.h>

static void check(XrResult result) {
    if (XR_FAILED(result)) {
        std::fprintf(stderr, "OpenXR: %d\n", result);
        std::exit(2);
    }
}

int main(int count, char**) {
    const char* layer = "XR_APILAYER_LUNARG_core_validation";
    const char* extensions[] = {"XR_MND_headless", "XR_EXT_eye_gaze_interaction", "XR_EXT_hand_tracking"};
    XrInstanceCreateInfo instance_info{XR_TYPE_INSTANCE_CREATE_INFO};
    std::strcpy(instance_info.applicationInfo.applicationName, "chains");
    instance_info.applicationInfo.apiVersion = XR_CURRENT_API_VERSION;
    instance_info.enabledApiLayerCount = count - 1;
    instance_info.enabledApiLayerNames = &layer;
    instance_info.enabledExtensionCount = 3;
    instance_info.enabledExtensionNames = extensions;
    XrInstance instance{};
    check(xrCreateInstance(&instance_info, &instance));
    XrSystemGetInfo system_info{XR_TYPE_SYSTEM_GET_INFO};
    system_info.formFactor = XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY;
    XrSystemId system{};
    check(xrGetSystem(instance, &system_info, &system));
    XrSessionCreateInfo session_info{XR_TYPE_SESSION_CREATE_INFO};
    session_info.systemId = system;
    XrSession session{};
    check(xrCreateSession(instance, &session_info, &session));
    XrReferenceSpaceCreateInfo space_info{XR_TYPE_REFERENCE_SPACE_CREATE_INFO};
    space_info.referenceSpaceType = XR_REFERENCE_SPACE_TYPE_VIEW;
    space_info.poseInReferenceSpace.orientation.w = 1;
    XrSpace space{};
    check(xrCreateReferenceSpace(session, &space_info, &space));

    const auto locate = [&](void* next) {
        XrSpaceLocation location{XR_TYPE_SPACE_LOCATION, next};
        return xrLocateSpace(space, space, 7, &location);
    };
    XrEyeGazeSampleTimeEXT sample{XR_TYPE_EYE_GAZE_SAMPLE_TIME_EXT};
    XrSpaceVelocity velocity{XR_TYPE_SPACE_VELOCITY};
    std::printf("%d", locate(&sample));
    std::printf(" %d", locate(&velocity));
    sample.time = velocity.velocityFlags = 0;
    sample.next = &velocity;
    XrResult result = locate(&sample);
    std::printf(" %d/%d", result, sample.time == 7 && velocity.velocityFlags == 3);
    sample.time = velocity.velocityFlags = 0;
    sample.next = nullptr;
    velocity.next = &sample;
    result = locate(&velocity);
    std::printf(" %d/%d", result, sample.time == 7 && velocity.velocityFlags == 3);
    XrBaseOutStructure unknown{XrStructureType(1000999000)};
    std::printf(" %d", locate(&unknown));
    XrSystemEyeGazeInteractionPropertiesEXT gaze{XR_TYPE_SYSTEM_EYE_GAZE_INTERACTION_PROPERTIES_EXT};
    XrSystemHandTrackingPropertiesEXT hands{XR_TYPE_SYSTEM_HAND_TRACKING_PROPERTIES_EXT, &gaze};
    XrSystemProperties properties{XR_TYPE_SYSTEM_PROPERTIES, &hands};
    std::printf(" %d\n", xrGetSystemProperties(instance, system, &properties));
    check(xrDestroyInstance(instance));
    return 0;
}
CODE
include=root/usr/include
g++ -std=c++17 -O1 -shared -fPIC "-I$include" runtime.cpp -o libruntime.so
g++ -std=c++17 -O1 "-I$include" application.cpp "$library/libopenxr_loader.so.1" -o application

unexpected=0
expect() { # expect WHAT FOUND STATED
    # shellcheck disable=SC2086  # one word for each column
    printf '%-18s %12s %9s %10s %10s %8s %10s\n' "$1" $2
    [[ $2 == "$3" ]] || unexpected=1
}
echo 'results, and /1 if both structures were filled'
printf '%-18s %12s %9s %10s %10s %8s %10s\n' '' 'sample time' velocity 'both' 'swapped' unknown 'properties'
expect 'without validation' "$(./application)" '0 0 0/1 0/1 0 0'
expect 'with' "$(./application on 2>log.txt | tail -n 1)" '0 0 -1/0 -1/0 -1 -1'
sed -n 's/^\[VALID_ERROR | \(VUID-Xr[^ ]*-next-next\) .*/  \1/p' said.txt | sort | uniq -c
if ((unexpected)); then
    echo 'NOT as stated: this finding is out of date'
    exit 1
fi
echo 'as stated'
