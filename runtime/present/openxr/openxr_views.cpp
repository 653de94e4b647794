#include "runtime/present/openxr/openxr_views.h"

#include <fmt/core.h>

#include <array>

#include "runtime/error.h"

namespace gazeloop::present {

using openxr::typed;

void OpenXrViews::locate(XrTime display_time, bool is_good) {
    auto info = typed<XrViewLocateInfo>(XR_TYPE_VIEW_LOCATE_INFO);
    info.viewConfigurationType = openxr::kStereo;
    info.displayTime = display_time;
    info.space = session_.local_space();
    auto state = typed<XrViewState>(XR_TYPE_VIEW_STATE);
    std::array<XrView, gaze::kEyeCount> views{typed<XrView>(XR_TYPE_VIEW),
                                              typed<XrView>(XR_TYPE_VIEW)};
    std::uint32_t count = 0;
    const XrResult located =
        xrLocateViews(session_.handle(), &info, &state, views.size(), &count, views.data());
    if (located == XR_ERROR_TIME_INVALID && !is_good) {
        return;  // as absurd to the runtime as to us
    }
    openxr::xr_check_session(located, "xrLocateViews");
    bool tracked = true;
    bool rendered_for = true;
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        const auto pose = openxr::from_xr(views[e].pose);
        if (pose && (state.viewStateFlags & XR_VIEW_STATE_ORIENTATION_VALID_BIT) != 0) {
            views_[e].pose.orientation = pose->orientation;
        } else {
            tracked = false;
        }
        if (pose && (state.viewStateFlags & XR_VIEW_STATE_POSITION_VALID_BIT) != 0) {
            views_[e].pose.position_m = pose->position_m;
        } else {
            tracked = false;
        }
        rendered_for = take_field_of_view(e, views[e].fov) && rendered_for;
    }
    say_change(tracked, tracked_, {frame::kHeadFoundEvent, "the head is tracked"},
               {frame::kHeadLostEvent, "the head is not tracked: its last known pose stands"});
    say_change(rendered_for, rendered_for_,
               {frame::kViewGoodEvent, "the fields of view can be rendered for"},
               {frame::kViewOddEvent,
                "a field of view that nothing can be rendered for: the last one stands"});
    if (const auto head = session_.head_at(display_time)) {
        head_ = *head;
    }
}

bool OpenXrViews::take_field_of_view(std::size_t eye, const XrFovf& fov) {
    gaze::EyeView view = views_[eye];
    view.fov = {fov.angleLeft, fov.angleRight, fov.angleUp, fov.angleDown};
    view.width_px = extents_[eye].width;
    view.height_px = extents_[eye].height;
    if (gaze::is_valid(view)) {
        views_[eye] = view;
        return true;
    }
    if (!gaze::is_valid(views_[eye])) {
        throw SetupError(ErrorKind::NoDevice,
                         fmt::format("{} gives the {} eye a field of view that nothing can be "
                                     "rendered for; use another runtime or --target headless",
                                     session_.instance().runtime_name(), gaze::kEyeNames[eye]));
    }
    return false;
}

void OpenXrViews::say_change(bool now, bool& before, const Said& good, const Said& bad) {
    if (now != before) {
        const Said& said = now ? good : bad;
        session_.tell(said.kind, said.text);
    }
    before = now;
}

}  // namespace gazeloop::present
