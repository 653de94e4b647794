#include "runtime/openxr_layer/stereo_views.h"

#include <array>

namespace gazeloop::openxr_layer {

std::optional<gaze::StereoView> stereo_of(const XrView* views) {
    gaze::StereoView stereo;
    for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
        const auto pose = openxr::from_xr(views[eye].pose);
        if (!pose) {
            return std::nullopt;
        }
        const XrFovf& fov = views[eye].fov;
        stereo[eye].pose = *pose;
        stereo[eye].fov = {fov.angleLeft, fov.angleRight, fov.angleUp, fov.angleDown};
    }
    return stereo;
}

std::optional<gaze::StereoView> stereo_views(const NextFunctions& next, XrSession session,
                                             XrSpace space, XrTime time) {
    XrViewLocateInfo info{};
    info.type = XR_TYPE_VIEW_LOCATE_INFO;
    info.viewConfigurationType = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
    info.displayTime = time;
    info.space = space;
    XrViewState state{};
    state.type = XR_TYPE_VIEW_STATE;
    std::array<XrView, gaze::kEyeCount> views{};
    views.fill({.type = XR_TYPE_VIEW, .next = nullptr, .pose = {}, .fov = {}});
    std::uint32_t count = 0;
    constexpr XrViewStateFlags kKnown =
        XR_VIEW_STATE_ORIENTATION_VALID_BIT | XR_VIEW_STATE_POSITION_VALID_BIT;
    if (XR_FAILED(
            next.LocateViews(session, &info, &state, gaze::kEyeCount, &count, views.data())) ||
        count != gaze::kEyeCount || (state.viewStateFlags & kKnown) != kKnown) {
        return std::nullopt;
    }
    return stereo_of(views.data());
}

}  // namespace gazeloop::openxr_layer
