#pragma once

#include <cstdint>

#include "runtime/frame/frame_record.h"

namespace gazeloop::latency {

inline constexpr std::int64_t kMs = 1'000'000;
inline constexpr std::int64_t kExamplePeriodNs = 10 * kMs;

/// What the examples were rendered by.
inline const frame::PassList kExamplePasses{"pass_i", "disc", "resolve"};
inline const frame::GridList kExampleGrids{"lp", "picture"};

/// Frame `index` of a loop that keeps up with a 100 Hz display: woken at index x 10 ms, its gaze
/// 5 ms old at the latch (3 ms tracker, 2 ms queue), submitted 1 ms later, 4 ms on the GPU (to be
/// told by example_gpu), shown 6 ms later: 16 ms after the eye was seen.
inline frame::FrameRecord example_frame(std::uint64_t index,
                                        time::StampKind clock = time::StampKind::Measured) {
    const std::int64_t wake_up = static_cast<std::int64_t>(index) * kExamplePeriodNs;
    const auto at = [&](std::int64_t ms) { return time::Stamp{wake_up + ms * kMs, clock}; };
    frame::FrameRecord frame;
    frame.index = index;
    frame.stamps.wake_up = at(0);
    frame.stamps.begin = at(1);
    frame.stamps.latch = at(2);
    frame.stamps.submit = at(3);
    frame.stamps.end_frame = at(4);
    frame.stamps.display = {
        at(13).ns, clock == time::StampKind::Measured ? time::StampKind::Predicted : clock};
    frame.period_ns = kExamplePeriodNs;
    frame.fovea.latched = frame.stamps.latch;
    for (gaze::FoveaPoint& eye : frame.fovea.eyes) {
        eye.state = gaze::FoveaState::Tracking;
        eye.reason = gaze::LossReason::None;
        eye.sample_sequence = index + 1;
        eye.sampled = {at(-3).ns, clock == time::StampKind::Measured ? time::StampKind::Profile
                                                                     : time::StampKind::Modelled};
        eye.arrived = at(0);
    }
    frame.samples.grid_count = 2;
    frame.samples.grids[0] = {.planned = 1000, .shaded = 800, .off_screen = 150, .covered = 50};
    frame.samples.grids[1] = {.planned = 200, .shaded = 200};
    frame.samples.pixels_output = 3400;
    return frame;
}

inline frame::FrameGpuRecord example_gpu(std::uint64_t index, std::int64_t gpu_ms = 4) {
    const time::Stamp submit = example_frame(index).stamps.submit;
    frame::FrameGpuRecord gpu;
    gpu.index = index;
    gpu.gpu_begin = submit;
    gpu.gpu_end = {submit.ns + gpu_ms * kMs, time::StampKind::Measured};
    gpu.passes.set(0, 3 * kMs);
    gpu.passes.set(2, kMs);  // there was no disc
    return gpu;
}

}  // namespace gazeloop::latency
