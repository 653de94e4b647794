#include "runtime/report/session_summary.h"

#include <array>
#include <memory>
#include <utility>

#include "runtime/latency/summary_observer.h"

namespace gazeloop::report {

latency::SummaryConfig summary_config(const display::DisplayProfile& display,
                                      latency::LoopClock clock) {
    return {.clock = clock,
            .period_ns = display.refresh_hz > 0.0 ? display.period_ns() : 0,
            .switching_ns = display.switching_ns,
            .rolling_ns = display.rolling_ns(),
            .persistence_ns = display.persistence_ns,
            .assumed = display.assumed_photons()};
}

Expected<SessionSummary> summarize(const session::OpenSession& session) {
    const session::SessionHeader& header = session.info().header;
    latency::SummaryConfig config = summary_config(header.meta.display, header.meta.clock);
    config.passes = header.passes;
    config.grids = header.grids;
    latency::LatencySummary summary(config);
    latency::SummaryObserver observer(summary);
    TraceAccount trace;
    TraceObserver tracing(trace);
    auto frames = std::make_unique<FrameLog>(config);
    const std::array<frame::FrameObserver*, 3> observers{&observer, &tracing, frames.get()};
    const Expected<bool> counted = session::has_gaze_counts(session);
    if (!counted) {
        return std::unexpected(counted.error());
    }
    auto end = session::play_ahead(
        session, observers, *counted ? session::PlayedGaze::Counts : session::PlayedGaze::Samples);
    if (!end) {
        return std::unexpected(std::move(end.error()));
    }
    frames->finish();
    return SessionSummary{.report = summary.report(),
                          .frames = std::move(frames),
                          .trace = std::move(trace),
                          .end = *std::move(end)};
}

}  // namespace gazeloop::report
