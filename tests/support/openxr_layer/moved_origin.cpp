// A runtime that moves the origin of LOCAL space: it turns it to the left by DEG degrees. Effects
// of xrWaitFrame:
//   recentre=DEG         announced two periods ahead with its pose; poses of earlier times stay in
//                        the space before, as OpenXR has it
//   recentre-unsaid=DEG  the same, without its pose
//   recentre-silent=DEG  not announced: from this frame on, for all times
// The compositor below knows nothing of it: its picture is not to be looked at.
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/support/openxr_layer/layer.h"

namespace gazeloop::tests {
namespace {

struct Moved {
    XrTime from;
    double by_rad;
};

XrSpace g_local = XR_NULL_HANDLE;
std::vector<Moved> g_moved;

XrQuaternionf yaw(double rad) {
    return {0.0F, static_cast<float>(std::sin(rad / 2.0)), 0.0F,
            static_cast<float>(std::cos(rad / 2.0))};
}

XRAPI_ATTR XrResult XRAPI_CALL create_reference_space(XrSession session,
                                                      const XrReferenceSpaceCreateInfo* info,
                                                      XrSpace* space) {
    const XrResult result =
        next<PFN_xrCreateReferenceSpace>("xrCreateReferenceSpace")(session, info, space);
    if (XR_SUCCEEDED(result) && info->referenceSpaceType == XR_REFERENCE_SPACE_TYPE_LOCAL) {
        g_local = *space;
    }
    return result;
}

}  // namespace

bool move_origin(std::string_view effect, const XrFrameState& state) {
    const std::size_t equals = effect.find('=');
    const std::string_view name = effect.substr(0, equals);
    const bool silent = name == "recentre-silent";
    if (equals == std::string_view::npos ||
        (name != "recentre" && name != "recentre-unsaid" && !silent)) {
        return false;
    }
    const std::string_view number = effect.substr(equals + 1);
    int degrees = 0;
    if (std::from_chars(number.data(), number.data() + number.size(), degrees).ec != std::errc{}) {
        refuse_fault("xrWaitFrame", effect);
    }
    const double by_rad = degrees * std::numbers::pi / 180.0;
    if (silent) {
        g_moved.push_back({std::numeric_limits<XrTime>::min(), by_rad});
        return true;
    }
    XrEventDataReferenceSpaceChangePending event{};
    event.type = XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING;
    event.session = layer().session;
    event.referenceSpaceType = XR_REFERENCE_SPACE_TYPE_LOCAL;
    event.changeTime = state.predictedDisplayTime + 2 * state.predictedDisplayPeriod;
    event.poseValid = name == "recentre" ? XR_TRUE : XR_FALSE;
    event.poseInPreviousSpace.orientation = yaw(by_rad);
    send(event);
    event.referenceSpaceType = XR_REFERENCE_SPACE_TYPE_STAGE;
    event.poseInPreviousSpace.orientation = yaw(by_rad + 1.0);
    send(event);
    g_moved.push_back({event.changeTime, by_rad});
    return true;
}

XrPosef in_moved_space(const XrPosef& pose, XrSpace space, XrTime time) {
    double by_rad = 0.0;
    for (const Moved& moved : g_moved) {
        by_rad += moved.from <= time ? moved.by_rad : 0.0;
    }
    if (by_rad == 0.0 || space != g_local) {
        return pose;
    }
    const auto cosine = static_cast<float>(std::cos(by_rad));
    const auto sine = static_cast<float>(std::sin(by_rad));
    const XrQuaternionf back = yaw(-by_rad);
    const XrQuaternionf& q = pose.orientation;
    XrPosef moved{};
    moved.orientation = {back.w * q.x + back.y * q.z, back.w * q.y + back.y * q.w,
                         back.w * q.z - back.y * q.x, back.w * q.w - back.y * q.y};
    moved.position = {cosine * pose.position.x - sine * pose.position.z, pose.position.y,
                      sine * pose.position.x + cosine * pose.position.z};
    return moved;
}

PFN_xrVoidFunction space_hook(std::string_view name) {
    return name == "xrCreateReferenceSpace" ? as_hook(&create_reference_space) : nullptr;
}

}  // namespace gazeloop::tests
