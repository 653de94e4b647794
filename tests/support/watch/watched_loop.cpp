#include "tests/support/watch/watched_loop.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "drivers/openxr/openxr_source.h"
#include "drivers/trace/trace_source.h"
#include "runtime/frame_loop.h"
#include "runtime/latency/summary_observer.h"
#include "runtime/methods/registry.h"
#include "runtime/present/headless_target.h"
#include "runtime/present/openxr/openxr_target.h"
#include "runtime/profiles/profiles.h"
#include "runtime/run/event_log.h"
#include "runtime/run/monitor_feed.h"
#include "runtime/run/program_settings.h"
#include "runtime/run/recording_observer.h"
#include "runtime/scene/scenes.h"
#include "runtime/time/clock.h"
#include "sim/gaze_generator.h"
#include "tests/support/watch/watched_call.h"
#include "tests/support/watch/watched_vulkan.h"

namespace gazeloop::tests {
namespace {

std::size_t resident_bytes() {
    std::FILE* const file = std::fopen("/proc/self/statm", "r");
    unsigned long size = 0;
    unsigned long resident = 0;
    if (file == nullptr || std::fscanf(file, "%lu %lu", &size, &resident) != 2) {
        throw SetupError(ErrorKind::NoDevice, "/proc/self/statm cannot be read");
    }
    std::fclose(file);
    return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

/// Notes when the loop looks for gaze.
class MarkingSource final : public drivers::GazeSource {
  public:
    explicit MarkingSource(std::unique_ptr<drivers::GazeSource> source)
        : source_(std::move(source)) {}
    void poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) override {
        mark_gaze();
        source_->poll(now_ns, samples);
    }
    void take_seen_depth(const gaze::SeenDepth& seen) override { source_->take_seen_depth(seen); }
    [[nodiscard]] std::vector<drivers::SourceEvent> take_events() override {
        return source_->take_events();
    }
    [[nodiscard]] const gaze::HeadMotion* head_track() const override {
        return source_->head_track();
    }
    [[nodiscard]] std::string description() const override { return source_->description(); }

  private:
    std::unique_ptr<drivers::GazeSource> source_;
};

/// Notes when the foveae are known: the loop then asks for the time.
class MarkingTimeline final : public LiveTimeline {
  public:
    using LiveTimeline::LiveTimeline;
    time::Stamp now() override {
        mark_foveae();
        return LiveTimeline::now();
    }
};

/// Comes last among the observers and draws the line between frames.
class FrameWatch final : public frame::FrameObserver {
  public:
    /// Its own memory is there, page by page, from the start.
    explicit FrameWatch(const WatchedLoop& options)
        : every_(options.resident_every), frames_(options.frames) {}
    void on_frame(const frame::FrameRecord& record) override {
        const Spent now = spent_outside_calls();
        const Spent spent = now - before_;
        WatchedFrame frame{.cpu_ns = spent.cpu_ns,
                           .gaze = record.should_render ? since_gaze() : SinceGaze{},
                           .allocations = spent.allocations,
                           .calls = spent.calls};
        if (every_ > 0 && record.index % every_ == 0) {
            frame.resident_bytes = resident_bytes();
        }
        frames_[seen_++] = frame;
        before_ = spent_outside_calls();
    }
    [[nodiscard]] std::vector<WatchedFrame> take() {
        frames_.resize(seen_);
        return std::move(frames_);
    }

  private:
    std::size_t every_;
    Spent before_ = spent_outside_calls();
    std::vector<WatchedFrame> frames_;
    std::size_t seen_ = 0;
};

std::unique_ptr<present::OpenXrTarget> make_openxr(const WatchedLoop& options,
                                                   const display::DisplayProfile& display) {
    if (!options.openxr) {
        return nullptr;
    }
    present::OpenXrOptions target{.display = display, .scale = options.scale};
    if (options.openxr_gaze) {
        target.extensions.push_back(drivers::kEyeGazeExtension);
    }
    return present::make_openxr_target(target);
}

std::unique_ptr<present::FrameTarget> make_headless(const WatchedLoop& options,
                                                    const display::DisplayProfile& display) {
    const auto scaled = [&](std::uint32_t side) {
        return std::max(2U, static_cast<std::uint32_t>(std::lround(side * options.scale)));
    };
    const vk::Extent2D extent(scaled(display.width_px), scaled(display.height_px));
    return std::make_unique<present::HeadlessTarget>(present::HeadlessTarget::Options{
        .display = display, .extents = {extent, extent}, .paced = options.paced});
}

}  // namespace

std::vector<WatchedFrame> run_watched_loop(const WatchedLoop& options) {
    const display::DisplayProfile display = value_or_throw(profiles::load_display("fove0"));
    // In this order, because the context is the last to go but for the runtime's instance.
    std::unique_ptr<vulkan::Context> context;
    std::unique_ptr<present::OpenXrTarget> openxr = make_openxr(options, display);
    present::OpenXrTarget* const shared = openxr.get();
    const std::unique_ptr<present::FrameTarget> target =
        openxr != nullptr ? std::move(openxr) : make_headless(options, display);
    context = std::make_unique<vulkan::Context>(vulkan::ContextOptions{}, target->vulkan_factory());
    watch_vulkan(*context);
    target->start(*context);
    render::RendererConfig config;
    config.extents = target->extents();
    config.format = target->format();
    config.hash = options.hash;
    config.seen_depth = options.openxr_gaze && options.from_depth;
    const run::ProgramSettings settings;
    const std::unique_ptr<scene::Scene> scene = scene::make_scene(*context, "raymarch");
    render::FrameRenderer renderer(
        *context, *scene,
        value_or_throw(
            methods::find_method(options.method)->passes(settings.values().methods, settings)),
        config);
    gaze::GazeToFovea gaze{gaze::FoveaPolicy{}};

    latency::LatencySummary summary(
        {.clock = latency::LoopClock::Wall, .period_ns = display.period_ns()});
    latency::SummaryObserver summing(summary);
    run::EventLog logging;
    FrameWatch watch(options);
    std::unique_ptr<session::SessionRecorder> recorder;
    std::optional<run::RecordingObserver> recording;
    LoopParts parts{
        .target = *target,
        .renderer = renderer,
        .gaze = gaze,
        .make_timeline = [] { return std::make_unique<MarkingTimeline>(time::measured_now().ns); },
        .make_source =
            [&](std::int64_t start_ns) {
                std::unique_ptr<drivers::GazeSource> source;
                if (options.openxr_gaze) {
                    source = std::make_unique<drivers::OpenXrSource>(
                        shared->session(),
                        drivers::OpenXrGazeOptions{.from_depth = options.from_depth});
                } else {
                    source = std::make_unique<drivers::TraceSource>(sim::generate_gaze({}, 300.0),
                                                                    start_ns, 10'000'000);
                }
                return std::make_unique<MarkingSource>(std::move(source));
            },
        .observers = {&summing, &logging}};
    if (!options.record.empty()) {
        recorder = value_or_throw(session::SessionRecorder::create(options.record, {}));
        recording.emplace(*recorder);
        parts.observers.push_back(&*recording);
    }
    std::unique_ptr<run::MonitorOutput> output;
    std::optional<run::MonitorFeed> monitor;
    if (options.monitor_fd >= 0) {
        // Broken as soon as anything can be, so that no event comes later, whose line allocates.
        const latency::LatencyBudget budget{
            .name = "of 1 us", .description = {}, .source = {}, .total_ns = 1000};
        output = std::make_unique<run::MonitorOutput>(
            run::MonitorOutputOptions{.json_fd = options.monitor_fd, .budget = budget});
        monitor.emplace(run::MonitorFeed::Options{.display = {.period_ns = display.period_ns()},
                                                  .budget = budget,
                                                  .window_ns = 1'000'000'000,
                                                  .interval_ns = 10'000'000,
                                                  .output = output.get()});
        monitor->tell(parts.observers);
        parts.observers.push_back(&*monitor);
    }
    parts.observers.push_back(&watch);
    LoopOptions loop;
    loop.frames = options.frames;
    run_frame_loop(parts, loop);
    if (recorder != nullptr && !recorder->close().complete()) {
        throw SetupError(ErrorKind::RecordingIncomplete, recorder->close().failure +
                                                             ": the watched loop's recording is "
                                                             "not complete");
    }
    return watch.take();
}

}  // namespace gazeloop::tests
