// Frames and views: what a recording is made of, and views as seen from the gaze.
#include <algorithm>
#include <array>

#include "runtime/openxr_layer/gaze_reading.h"
#include "runtime/openxr_layer/quad_views/quad_views.h"
#include "runtime/openxr_layer/stereo_views.h"
#include "runtime/time/clock.h"

namespace gazeloop::openxr_layer {
namespace {

using Next = NextFunctions;

/// Calls `use(LayeredSession&)` where the session is recorded, under the instance's lock.
template <typename Use>
void if_recorded(LayeredInstance& layered, XrSession session, Use&& use) {
    const std::lock_guard lock(layered.mutex);
    LayeredSession* const known = layered.session(session);
    if (known != nullptr && known->tap != nullptr) {
        use(*known);
    }
}

XrResult wait_frame(Call<&Next::WaitFrame>& call, XrSession session, const XrFrameWaitInfo* info,
                    XrFrameState* state) {
    const XrResult result = call.down(session, info, state);
    if (XR_FAILED(result)) {
        return result;
    }
    LayeredInstance& layered = call.instance();
    const std::int64_t now_ns = time::monotonic_ns();
    const std::lock_guard lock(layered.mutex);
    layered.times.see_announced(state->predictedDisplayTime, now_ns);
    LayeredSession* const known = layered.session(session);
    if (known != nullptr) {
        known->display = state->predictedDisplayTime;
    }
    if (known != nullptr && known->tap != nullptr) {
        known->tap->waited(state->predictedDisplayTime, now_ns,
                           {.display_ns = layered.times.host_ns(state->predictedDisplayTime),
                            .period_ns = state->predictedDisplayPeriod,
                            .should_render = state->shouldRender == XR_TRUE});
    }
    return result;
}

XrResult begin_frame(Call<&Next::BeginFrame>& call, XrSession session,
                     const XrFrameBeginInfo* info) {
    const XrResult result = call.down(session, info);
    if (XR_SUCCEEDED(result)) {
        if_recorded(call.instance(), session,
                    [](LayeredSession& known) { known.tap->begun(time::monotonic_ns()); });
    }
    return result;
}

constexpr XrViewStateFlags kViewsKnown =
    XR_VIEW_STATE_ORIENTATION_VALID_BIT | XR_VIEW_STATE_POSITION_VALID_BIT;

/// Views in a space that stands still, and the samples that came until they were asked for. Under
/// the instance's lock.
void tell_located(LayeredInstance& layered, LayeredSession& session, XrTime display,
                  const gaze::StereoView& views) {
    const std::int64_t now_ns = time::monotonic_ns();
    if (session.feed != nullptr) {
        session.feed->take(
            now_ns, [&](const GazeHistory& history) { tell_samples(layered, session, history); });
    }
    session.tap->located(display, now_ns, views);
}

/// Recorded views are in a space that stands still: where the application asks in one that is fixed
/// to its head, they are asked for once more.
void record_views(LayeredInstance& layered, XrSession session, const XrViewLocateInfo& info,
                  XrViewStateFlags flags, const XrView* views) {
    if_recorded(layered, session, [&](LayeredSession& known) {
        XrViewLocateInfo still = info;
        std::array<XrView, gaze::kEyeCount> again{};
        if (std::ranges::find(known.view_spaces, info.space) != known.view_spaces.end()) {
            still.next = nullptr;
            still.space = known.local_space;
            again.fill({.type = XR_TYPE_VIEW, .next = nullptr, .pose = {}, .fov = {}});
            XrViewState state{};
            state.type = XR_TYPE_VIEW_STATE;
            std::uint32_t count = 0;
            if (known.local_space == XR_NULL_HANDLE ||
                XR_FAILED(layered.next.LocateViews(session, &still, &state, gaze::kEyeCount, &count,
                                                   again.data())) ||
                count != gaze::kEyeCount) {
                return;
            }
            flags = state.viewStateFlags;
            views = again.data();
        }
        const auto stereo = stereo_of(views);
        if ((flags & kViewsKnown) != kViewsKnown || !stereo) {
            return;
        }
        known.views_in = still.space;
        tell_located(layered, known, info.displayTime, *stereo);
    });
}

XrResult locate_as_asked(Call<&Next::LocateViews>& call, XrSession session,
                         const XrViewLocateInfo* info, XrViewState* state, std::uint32_t capacity,
                         std::uint32_t* count, XrView* views) {
    LayeredInstance& layered = call.instance();
    const auto locate =
        info != nullptr ? locating(layered, XR_NULL_HANDLE, info->space) : std::nullopt;
    if (!locate || !locate->base->gives_gaze) {
        const XrResult result = call.down(session, info, state, capacity, count, views);
        if (XR_SUCCEEDED(result) && capacity >= gaze::kEyeCount && *count == gaze::kEyeCount &&
            info->viewConfigurationType == XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO) {
            record_views(layered, session, *info, state->viewStateFlags, views);
        }
        return result;
    }
    // From the gaze: the views in the head, and the head from the gaze.
    XrViewLocateInfo from_head = *info;
    from_head.space = locate->view_space;
    const XrViewLocateInfo* const passed = &from_head;
    const XrResult result = call.down(session, passed, state, capacity, count, views);
    if (XR_FAILED(result) || capacity == 0) {
        return result;
    }
    const auto gaze = gaze_at(*locate, info->displayTime);
    if (!gaze) {
        state->viewStateFlags = 0;
        return result;
    }
    const gaze::Pose back =
        gaze::inverse(gaze::compose(gaze->in_head.pose, locate->base->space.pose_in_gaze));
    for (std::uint32_t i = 0; i < *count; ++i) {
        if (const auto pose = openxr::from_xr(views[i].pose)) {
            views[i].pose = openxr::to_xr(gaze::compose(back, *pose));
        }
    }
    note_gaze_read(layered, locate->session);
    return result;
}

/// The gaze of an inset is read here, after the runtime has said where the head is.
XrResult locate_views(Call<&Next::LocateViews>& call, XrSession session,
                      const XrViewLocateInfo* info, XrViewState* state, std::uint32_t capacity,
                      std::uint32_t* count, XrView* views) {
    LayeredInstance& layered = call.instance();
    if (!layered.owns.quad_views || info == nullptr || info->viewConfigurationType != kQuadViews ||
        count == nullptr) {
        return locate_as_asked(call, session, info, state, capacity, count, views);
    }
    XrViewLocateInfo of_two = *info;
    of_two.viewConfigurationType = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
    gaze::PerEye<XrView> two{};
    two.fill({.type = XR_TYPE_VIEW, .next = nullptr, .pose = {}, .fov = {}});
    std::uint32_t located = 0;
    const XrResult result =
        locate_as_asked(call, session, &of_two, state, static_cast<std::uint32_t>(two.size()),
                        &located, two.data());
    if (XR_FAILED(result)) {
        return result;
    }
    *count = kQuadViewCount;
    if (capacity == 0) {
        return result;
    }
    if (capacity < kQuadViewCount || views == nullptr) {
        return views == nullptr ? XR_ERROR_VALIDATION_FAILURE : XR_ERROR_SIZE_INSUFFICIENT;
    }
    fill_four_views(layered, session, info->displayTime, two, views);
    return result;
}

/// Of the first layer that is a stereo picture. Where all layers are panels, they are seen by views
/// of the display's size.
FramePictures pictures_of(const XrFrameEndInfo& info, const std::optional<PictureSize>& full) {
    FramePictures pictures;
    for (std::uint32_t i = 0; i < info.layerCount && info.layers != nullptr; ++i) {
        const XrCompositionLayerBaseHeader* const layer = info.layers[i];
        if (layer == nullptr || layer->type != XR_TYPE_COMPOSITION_LAYER_PROJECTION) {
            continue;
        }
        const auto& projection = *reinterpret_cast<const XrCompositionLayerProjection*>(layer);
        if (projection.viewCount < gaze::kEyeCount || projection.views == nullptr) {
            continue;
        }
        for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
            const XrExtent2Di& extent = projection.views[eye].subImage.imageRect.extent;
            pictures.sizes_px[eye] = {static_cast<std::uint32_t>(std::max(extent.width, 0)),
                                      static_cast<std::uint32_t>(std::max(extent.height, 0))};
        }
        return pictures;
    }
    if (info.layerCount > 0 && full) {
        pictures.of_views = false;
        pictures.sizes_px.fill({full->width_px, full->height_px});
    }
    return pictures;
}

/// An application may show panels alone and ask for no views. Its wearer sees by them all the same,
/// so they are asked for in its place.
void record_views_of_panels(LayeredInstance& layered, XrSession session,
                            const XrFrameEndInfo& info) {
    if_recorded(layered, session, [&](LayeredSession& known) {
        if (info.layerCount == 0 || known.local_space == XR_NULL_HANDLE ||
            !known.tap->lacks_views(info.displayTime)) {
            return;
        }
        const auto views = stereo_views(layered.next, session, known.local_space, info.displayTime);
        if (!views) {
            return;
        }
        known.views_in = known.local_space;
        tell_located(layered, known, info.displayTime, *views);
    });
}

/// What the compositing of frames cost the GPU, as far as it has finished them.
void tell_composites(LayeredSession& session) {
    while (const auto timed = session.quad->take_timed()) {
        session.tap->composited(timed->frame, timed->ns);
    }
}

XrResult end_frame(Call<&Next::EndFrame>& call, XrSession session, const XrFrameEndInfo* info) {
    LayeredInstance& layered = call.instance();
    std::shared_ptr<QuadSession> quad;
    std::optional<std::uint64_t> frame;
    if (info != nullptr) {
        record_views_of_panels(layered, session, *info);
    }
    const std::int64_t before_ns = time::monotonic_ns();
    if (layered.owns.quad_views && info != nullptr) {
        const std::lock_guard lock(layered.mutex);
        const LayeredSession* const known = layered.session(session);
        if (known != nullptr && known->quad != nullptr && known->quad->has_four_views()) {
            quad = known->quad;
            frame = known->tap != nullptr ? std::optional(known->tap->next_index()) : std::nullopt;
        }
    }
    const XrResult result =
        quad != nullptr ? quad->end_frame(*info, frame) : call.down(session, info);
    if (XR_SUCCEEDED(result)) {
        if_recorded(layered, session, [&](LayeredSession& known) {
            known.tap->ended(info->displayTime, before_ns, time::monotonic_ns(),
                             pictures_of(*info, known.full));
            if (quad != nullptr) {
                tell_composites(known);
            }
        });
    }
    return result;
}

}  // namespace

std::span<const Hook> frame_hooks() {
    static const std::array kHooks{
        hook<&Next::WaitFrame, &wait_frame>("xrWaitFrame"),
        hook<&Next::BeginFrame, &begin_frame>("xrBeginFrame"),
        hook<&Next::LocateViews, &locate_views>("xrLocateViews"),
        hook<&Next::EndFrame, &end_frame>("xrEndFrame"),
    };
    return kHooks;
}

}  // namespace gazeloop::openxr_layer
