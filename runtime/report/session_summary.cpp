#include "runtime/report/session_summary.h"

#include <memory>
#include <utility>
#include <vector>

#include "runtime/latency/summary_observer.h"
#include "runtime/report/eye_events.h"
#include "runtime/report/summary_rows.h"
#include "runtime/session/cursor.h"

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

namespace {

/// Enough for the most saccades that are looked at, at any rate; longer sessions would be read for
/// this alone.
constexpr std::uint64_t kMostSamples = 300'000;

/// Tells both the session's first samples, where a session was played without them.
Expected<void> tell_first_samples(const session::OpenSession& session, LagObserver& lag,
                                  EyeEvents& eyes) {
    session::SampleCursor samples(session);
    session::OriginCursor origins(session);
    if (auto moved = origins.next(); !moved) {
        return std::unexpected(std::move(moved.error()));
    }
    for (std::uint64_t told = 0;; ++told) {
        auto moved = samples.next();
        if (!moved) {
            return std::unexpected(std::move(moved.error()));
        }
        if (!*moved) {
            return {};
        }
        if (told == kMostSamples) {
            lag.stop_samples();
            return {};
        }
        const session::RecordedSample& row = *samples.row();
        while (origins.row() != nullptr && origins.row()->frame <= row.frame) {
            lag.on_origin(*origins.row());
            eyes.on_origin(*origins.row());
            if (auto next = origins.next(); !next) {
                return std::unexpected(std::move(next.error()));
            }
        }
        lag.on_sample(row.sample, row.frame);
        eyes.on_sample(row.sample, row.frame);
    }
}

}  // namespace

Expected<SessionSummary> summarize(const session::OpenSession& session, const RuntimeFiles& files,
                                   const AlsoTold& also) {
    const session::SessionHeader& header = session.info().header;
    latency::SummaryConfig config = summary_config(header.meta.display, header.meta.clock);
    config.passes = header.passes;
    config.grids = header.grids;
    latency::LatencySummary summary(config);
    latency::SummaryObserver observer(summary);
    TraceAccount trace;
    TraceObserver tracing(trace);
    LagObserver lag;
    EyeEvents eyes;
    auto frames = std::make_unique<FrameLog>(config);
    std::vector<frame::FrameObserver*> observers{&observer, &tracing, frames.get(), &lag, &eyes};
    observers.insert(observers.end(), also.observers.begin(), also.observers.end());
    auto runtime = RuntimeAccount::open(files, header.meta.runtime_metrics);
    if (!runtime) {
        return std::unexpected(std::move(runtime.error()));
    }
    const Expected<bool> counted = session::has_gaze_counts(session);
    if (!counted) {
        return std::unexpected(counted.error());
    }
    const bool by_counts = *counted && also.gaze == session::PlayedGaze::Counts;
    auto end =
        session::play_ahead(session, runtime->joined(observers),
                            by_counts ? session::PlayedGaze::Counts : session::PlayedGaze::Samples);
    if (!end) {
        return std::unexpected(std::move(end.error()));
    }
    if (by_counts) {
        if (auto told = tell_first_samples(session, lag, eyes); !told) {
            return std::unexpected(std::move(told.error()));
        }
    }
    frames->finish();
    frames->set_eye_events(eyes);
    latency::SummaryReport report = summary.report();
    take_exact_percentiles(*frames, report);
    return SessionSummary{.report = std::move(report),
                          .frames = std::move(frames),
                          .trace = std::move(trace),
                          .runtime = *std::move(runtime),
                          .origin = lag.origin(),
                          .use = lag.use(),
                          .smoothing = lag.smoothing(),
                          .unplaced = lag.unplaced(),
                          .end = *std::move(end)};
}

}  // namespace gazeloop::report
