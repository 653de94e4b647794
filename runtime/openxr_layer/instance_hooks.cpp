// Instance, system, events, session.
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cctype>
#include <chrono>
#include <filesystem>

#include "runtime/openxr_layer/hook.h"
#include "runtime/version.h"

namespace gazeloop::openxr_layer {
namespace {

using Next = NextFunctions;

XrResult destroy_instance(Call<&Next::DestroyInstance>& call, XrInstance instance) {
    const Instances::Pointer layered = call.pointer();
    {
        const std::lock_guard lock(layered->mutex);
        layered->end_sessions();
        layered->feed.reset();
    }
    Instances::all().remove(instance);
    return call.down(instance);
}

XrResult poll_event(Call<&Next::PollEvent>& call, XrInstance instance, XrEventDataBuffer* event) {
    LayeredInstance& layered = call.instance();
    if (event != nullptr) {
        const std::lock_guard lock(layered.mutex);
        if (!layered.events.empty()) {
            *event = layered.events.front();
            layered.events.pop_front();
            return XR_SUCCESS;
        }
    }
    return call.down(instance, event);
}

XrResult get_system_properties(Call<&Next::GetSystemProperties>& call, XrInstance instance,
                               XrSystemId system, XrSystemProperties* properties) {
    const XrResult result = call.down(instance, system, properties);
    if (XR_SUCCEEDED(result) && call.instance().owns.foveation_state) {
        auto* const foveation = in_chain<newer::SystemFoveationEyeTrackedProperties>(
            properties->next, newer::kSystemFoveationEyeTrackedProperties);
        if (foveation != nullptr) {
            foveation->supportsFoveationEyeTracked =
                call.instance().feed != nullptr ? XR_TRUE : XR_FALSE;
        }
    }
    if (XR_SUCCEEDED(result) && call.instance().provides_eye_gaze()) {
        auto* const eyes = in_chain<XrSystemEyeGazeInteractionPropertiesEXT>(
            properties->next, XR_TYPE_SYSTEM_EYE_GAZE_INTERACTION_PROPERTIES_EXT);
        if (eyes != nullptr) {
            eyes->supportsEyeGazeInteraction = call.instance().feed != nullptr ? XR_TRUE : XR_FALSE;
        }
    }
    return result;
}

/// FOLDER/NAME-20250131-123456-PID[-2].gaze where a folder is named, else the file itself.
std::filesystem::path session_file(const LayeredInstance& layered) {
    std::filesystem::path named = layered.configuration.values.layer.record;
    std::error_code failure;
    if (!std::filesystem::is_directory(named, failure)) {
        return named;
    }
    std::string name = std::filesystem::path(layered.sighting.executable).filename().string();
    for (char& letter : name) {
        letter = std::isalnum(static_cast<unsigned char>(letter)) != 0 ? letter : '_';
    }
    const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    const std::string stem =
        fmt::format("{}-{:%Y%m%d-%H%M%S}-{}", name, fmt::gmtime(now), ::getpid());
    std::filesystem::path file = named / (stem + ".gaze");
    // A program may make one session after another.
    for (int again = 2; std::filesystem::exists(file, failure); ++again) {
        file = named / fmt::format("{}-{}.gaze", stem, again);
    }
    return file;
}

session::SessionHeader header_of(const LayeredInstance& layered) {
    session::SessionHeader header;
    header.meta.program = fmt::format("gazeloop layer {}", kVersion);
    header.meta.command_line = layered.sighting.executable;
    header.meta.started_utc = utc_now();
    header.meta.clock = latency::LoopClock::Wall;
    header.meta.target = "openxr";
    header.meta.display.name = "that of " + layered.runtime;
    header.config = layered.configuration.list;
    if (layered.owns.quad_views) {
        header.passes = frame::PassList{"composite"};
    }
    header.device = {{"target", "openxr"},
                     {"application", layered.application},
                     {"openxr_runtime", layered.runtime}};
    return header;
}

/// A recording that cannot be made is said, and missed by nobody else.
std::unique_ptr<FrameTap> open_tap(LayeredInstance& layered) {
    const LayerValues& values = layered.configuration.values;
    if (values.layer.record.empty()) {
        return nullptr;
    }
    const std::filesystem::path file = session_file(layered);
    auto tap = FrameTap::open(file, header_of(layered), gaze::fovea_policy(values.gaze));
    if (!tap) {
        say(LogLevel::Warning, tap.error().message + ": nothing is recorded");
        return nullptr;
    }
    layered.sighting.recording = std::filesystem::absolute(file).string();
    keep(layered.sighting);
    (*tap)->event("gaze-source", values.layer.gaze.empty() ? "none" : values.layer.gaze);
    return std::move(*tap);
}

XrSpace reference_space(const LayeredInstance& layered, XrSession session,
                        XrReferenceSpaceType type) {
    XrReferenceSpaceCreateInfo info{};
    info.type = XR_TYPE_REFERENCE_SPACE_CREATE_INFO;
    info.referenceSpaceType = type;
    info.poseInReferenceSpace.orientation.w = 1.0F;
    XrSpace space = XR_NULL_HANDLE;
    return XR_SUCCEEDED(layered.next.CreateReferenceSpace(session, &info, &space)) ? space
                                                                                   : XR_NULL_HANDLE;
}

/// Four views are composited with Vulkan alone; null for another session.
std::shared_ptr<QuadSession> quad_session(const LayeredInstance& layered,
                                          const XrSessionCreateInfo& info, XrSession session) {
    const auto* const vulkan =
        in_chain<XrGraphicsBindingVulkanKHR>(info.next, XR_TYPE_GRAPHICS_BINDING_VULKAN_KHR);
    const auto full = recommended_size(layered.next, layered.handle, info.systemId);
    if (vulkan == nullptr || !full) {
        return nullptr;
    }
    return std::make_shared<QuadSession>(
        layered.next, session,
        ApplicationDevice{vulkan->instance, vulkan->physicalDevice, vulkan->device,
                          vulkan->queueFamilyIndex, vulkan->queueIndex},
        quad_sizes(*full, layered.inset_policy), layered.inset_policy);
}

XrResult create_session(Call<&Next::CreateSession>& call, XrInstance instance,
                        const XrSessionCreateInfo* info, XrSession* session) {
    const XrResult result = call.down(instance, info, session);
    if (XR_FAILED(result)) {
        return result;
    }
    LayeredInstance& layered = call.instance();
    Instances::all().add_child(*session, call.pointer(), *session);
    auto quad = layered.owns.quad_views ? quad_session(layered, *info, *session) : nullptr;
    const XrSpace view = reference_space(layered, *session, XR_REFERENCE_SPACE_TYPE_VIEW);
    const XrSpace local = reference_space(layered, *session, XR_REFERENCE_SPACE_TYPE_LOCAL);
    const std::lock_guard lock(layered.mutex);
    LayeredSession& made = layered.sessions[*session];
    made.handle = *session;
    made.view_space = view;
    made.local_space = local;
    made.feed = layered.feed;
    made.quad = std::move(quad);
    if (layered.owns.foveation_state || layered.owns.quad_views) {
        made.foveae.emplace(gaze::fovea_policy(layered.configuration.values.gaze));
    }
    made.active.reserve(16);
    made.synced.reserve(16);
    made.tap = open_tap(layered);
    if (made.tap != nullptr) {
        made.full = recommended_size(layered.next, layered.handle, info->systemId);
    }
    return result;
}

XrResult destroy_session(Call<&Next::DestroySession>& call, XrSession session) {
    LayeredInstance& layered = call.instance();
    {
        const std::lock_guard lock(layered.mutex);
        layered.end_session(session);
    }
    Instances::all().remove_session(session);
    return call.down(session);
}

}  // namespace

std::span<const Hook> instance_hooks() {
    static const std::array kHooks{
        hook<&Next::DestroyInstance, &destroy_instance>("xrDestroyInstance"),
        hook<&Next::PollEvent, &poll_event>("xrPollEvent"),
        hook<&Next::GetSystemProperties, &get_system_properties>("xrGetSystemProperties"),
        hook<&Next::CreateSession, &create_session>("xrCreateSession"),
        hook<&Next::DestroySession, &destroy_session>("xrDestroySession"),
    };
    return kHooks;
}

}  // namespace gazeloop::openxr_layer
