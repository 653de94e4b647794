#include "runtime/preview/stage_bars.h"

#include <algorithm>
#include <string_view>

#include "runtime/latency/gaze_age.h"
#include "runtime/time/milliseconds.h"

namespace gazeloop::preview {
namespace {

BarText text(std::string_view from) {
    BarText to{};
    from.copy(to.data(), to.size() - 1);
    return to;
}

void add(StageBar& bar, std::string_view name, const time::Span& span) {
    bar.segments[bar.count++] = {text(name),
                                 span.known() ? static_cast<double>(span.ns) / time::kNsPerMs : 0.0,
                                 span.known()};
}

void set_total(StageBar& bar, const time::Span& span) {
    bar.total_known = span.known();
    bar.total_ms = span.known() ? static_cast<double>(span.ns) / time::kNsPerMs : 0.0;
}

}  // namespace

StageBars stage_bars(const frame::FrameRecord& frame, const frame::FrameGpuRecord& gpu,
                     const frame::PassList& passes, const DisplayTimes& display) {
    StageBars result{.frame = frame.index,
                     .any = true,
                     .budget_ms = static_cast<double>(frame.period_ns) / time::kNsPerMs,
                     .bars = {}};

    frame::FrameStamps stamps = frame.stamps;
    stamps.gpu_begin = gpu.gpu_begin;
    stamps.gpu_end = gpu.gpu_end;
    const bool ours = latency::may_be_of_period(frame.period_ns, display.period_ns);
    const latency::GazeAge age = latency::frame_gaze_age(
        frame, stamps, latency::shown_frame(stamps, frame.period_ns).at,
        ours ? display.switching_ns : std::nullopt, ours ? display.rolling_ns : std::nullopt);
    StageBar& photon = result.bars[0];
    photon.title = text("eye to photon");
    for (std::size_t stage = 0; stage < latency::kStageCount; ++stage) {
        if (!age.stages[stage].known() && latency::shown_only_if_known(stage)) {
            continue;
        }
        add(photon, latency::kStageNames[stage], age.stages[stage]);
    }
    set_total(photon, age.at_display);

    StageBar& work = result.bars[1];
    work.title = text("GPU");
    for (std::size_t pass = 0; pass < passes.size(); ++pass) {
        if (const auto ns = gpu.passes[pass]) {
            add(work, passes[pass], {*ns, time::StampKind::Measured});
        }
    }
    set_total(work, time::between(gpu.gpu_begin, gpu.gpu_end));
    return result;
}

double bar_scale_ms(const StageBars& bars) {
    constexpr double kMargin = 1.15;
    double longest = bars.budget_ms;
    for (const StageBar& bar : bars.bars) {
        double sum = 0.0;
        for (std::uint32_t i = 0; i < bar.count; ++i) {
            sum += std::max(bar.segments[i].ms, 0.0);
        }
        longest = std::max({longest, sum, bar.total_ms});
    }
    return std::max(longest * kMargin, 1.0);
}

}  // namespace gazeloop::preview
