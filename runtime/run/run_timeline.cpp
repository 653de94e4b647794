#include "runtime/run/run_timeline.h"

#include "runtime/time/clock.h"
#include "runtime/time/milliseconds.h"

namespace gazeloop::run {

gaze::StereoView profile_views(const display::DisplayProfile& profile,
                               const gaze::PerEye<vk::Extent2D>& extents) {
    gaze::StereoView views;
    for (const gaze::Eye eye : gaze::kEyes) {
        const std::size_t e = gaze::index(eye);
        views[e] = display::profile_view(profile, eye, extents[e].width, extents[e].height);
    }
    return views;
}

std::unique_ptr<FrameTimeline> run_timeline(const FrameRunRequest& request,
                                            const display::DisplayProfile& profile,
                                            const gaze::PerEye<vk::Extent2D>& extents) {
    switch (request.clock) {
        case RunClock::Wall:
            break;
        case RunClock::Virtual:
            return std::make_unique<VirtualTimeline>(VirtualTimeline::Model{
                .period_ns = profile.period_ns(),
                .gpu_ns = time::ms_to_ns(request.settings->values().virtual_time.gpu_ms),
                .views = profile_views(profile, extents)});
        case RunClock::Recorded:
            return std::make_unique<RecordedTimeline>(*request.recording->session,
                                                      request.recording->frames);
    }
    return std::make_unique<LiveTimeline>(time::measured_now().ns);
}

}  // namespace gazeloop::run
