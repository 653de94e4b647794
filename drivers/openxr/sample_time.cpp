#include "drivers/openxr/sample_time.h"

#include <array>

#include "runtime/time/span.h"

namespace gazeloop::drivers {

std::string_view text_of(SampleTimeTrouble trouble) {
    constexpr std::array<std::string_view, 6> kTexts{
        "the runtime says when the eye was seen",
        "the runtime gives no time: the age is unknown",
        "the runtime predicts the gaze: when the eye was seen is unknown",
        "the gaze's time lies ahead, it is predicted: when the eye was seen is unknown",
        "the gaze moves, its time stands still: the age is unknown",
        "the gaze's time is none of now, but of another clock: the age is unknown"};
    return kTexts[static_cast<std::size_t>(trouble)];
}

SampleTime sample_time(const GivenTime& time) {
    if (time.given == 0) {
        return {.sampled = {}, .pose_ns = {}, .trouble = SampleTimeTrouble::NotGiven};
    }
    constexpr SampleTime kAbsurd{
        .sampled = {}, .pose_ns = {}, .trouble = SampleTimeTrouble::Absurd};
    if (time.given < 0 || !time.host_ns) {
        return kAbsurd;
    }
    const std::int64_t ahead_ns =
        time::saturated(static_cast<__int128>(*time.host_ns) - time.now_ns);
    if (ahead_ns > kFarthestSample_ns || ahead_ns < -kFarthestSample_ns) {
        return kAbsurd;
    }
    SampleTime sample{.sampled = {}, .pose_ns = time.host_ns, .trouble = SampleTimeTrouble::None};
    if (time.given == time.asked) {
        sample.trouble = SampleTimeTrouble::Predicted;
    } else if (ahead_ns > kClockNoise_ns) {
        sample.trouble = SampleTimeTrouble::Ahead;
    } else {
        sample.sampled = {*time.host_ns, time::StampKind::Measured};
    }
    return sample;
}

}  // namespace gazeloop::drivers
