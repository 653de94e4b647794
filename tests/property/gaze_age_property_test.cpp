#include "runtime/latency/gaze_age.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace gazeloop::latency {
namespace {

/// Unknown once in eight times.
time::Stamp any_stamp(std::int64_t within_ns) {
    const int kind = *rc::gen::inRange(0, 8);
    return {
        *rc::gen::inRange(-within_ns, within_ns),
        static_cast<time::StampKind>(kind < static_cast<int>(time::kStampKindCount) ? kind : 1)};
}

struct Drawn {
    gaze::FoveaPoint fovea;
    frame::FrameStamps stamps;
    std::int64_t period_ns;
    std::optional<std::int64_t> switching_ns;
    std::optional<std::int64_t> row_ns;
};

Drawn any_frame(std::int64_t within_ns) {
    Drawn drawn;
    drawn.fovea.sampled = any_stamp(within_ns);
    drawn.fovea.arrived = any_stamp(within_ns);
    drawn.fovea.ready = any_stamp(within_ns);
    for (time::Stamp* stamp : {&drawn.stamps.latch, &drawn.stamps.filtered, &drawn.stamps.submit,
                               &drawn.stamps.gpu_begin, &drawn.stamps.gpu_end,
                               &drawn.stamps.present, &drawn.stamps.display, &drawn.stamps.shown}) {
        *stamp = any_stamp(within_ns);
    }
    drawn.period_ns = *rc::gen::inRange<std::int64_t>(-1, 20'000'000);
    if (*rc::gen::arbitrary<bool>()) {
        drawn.switching_ns = *rc::gen::inRange<std::int64_t>(0, 10'000'000);
    }
    if (*rc::gen::arbitrary<bool>()) {
        drawn.row_ns = *rc::gen::inRange<std::int64_t>(-10'000'000, 10'000'000);
    }
    return drawn;
}

RC_GTEST_PROP(GazeAge, StagesAndTheRestAddUpExactly, ()) {
    const Drawn drawn = any_frame(1'000'000'000'000'000);
    const ShownFrame shown = shown_frame(drawn.stamps, drawn.period_ns);
    const GazeAge age =
        gaze_age(drawn.fovea, drawn.stamps, shown.at, drawn.switching_ns, drawn.row_ns);
    if (!age.at_display.known()) {
        return;
    }

    std::int64_t sum_ns = age.unaccounted.ns;
    bool all_known = true;
    for (std::size_t stage = 0; stage < kStageCount; ++stage) {
        sum_ns += age.stages[stage].known() ? age.stages[stage].ns : 0;
        if (stage < static_cast<std::size_t>(Stage::Row) && !shown_only_if_known(stage)) {
            all_known = all_known && age.stages[stage].known();
        }
    }
    RC_ASSERT(sum_ns == age.at_display.ns);
    if (all_known) {
        const std::int64_t before_gpu_ns = drawn.stamps.gpu_begin.ns - drawn.stamps.submit.ns;
        RC_ASSERT(age.unaccounted.ns == std::max<std::int64_t>(before_gpu_ns, 0));
    }
}

RC_GTEST_PROP(GazeAge, AFrameIsNeverShownBeforeItIsFinished, ()) {
    Drawn drawn = any_frame(1'000'000'000);
    drawn.stamps.shown = {};  // else the runtime knows better
    const ShownFrame shown = shown_frame(drawn.stamps, drawn.period_ns);
    if (!shown.in_time_known || !shown.at.known()) {
        return;
    }
    RC_ASSERT(shown.at.ns >= drawn.stamps.gpu_end.ns);
    RC_ASSERT(shown.at.ns >= drawn.stamps.display.ns);
    RC_ASSERT(shown.at.ns - std::max(drawn.stamps.gpu_end.ns, drawn.stamps.display.ns) <
              std::max<std::int64_t>(drawn.period_ns, 1));
}

RC_GTEST_PROP(GazeAge, TakesAnyTimes, ()) {
    const Drawn drawn = any_frame(std::numeric_limits<std::int64_t>::max());
    const ShownFrame shown = shown_frame(drawn.stamps, drawn.period_ns);
    const GazeAge age =
        gaze_age(drawn.fovea, drawn.stamps, shown.at, drawn.switching_ns, drawn.row_ns);
    RC_ASSERT(age.at_display.known() == (drawn.fovea.sampled.known() && shown.at.known()));
}

}  // namespace
}  // namespace gazeloop::latency
