#include "runtime/run/frame_run.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "drivers/anatomy/anatomy_source.h"
#include "drivers/calibrated/calibrated_source.h"
#include "drivers/openxr/answer_actions.h"
#include "runtime/calibration/calibration_settings.h"
#include "runtime/latency/summary_observer.h"
#include "runtime/methods/registry.h"
#include "runtime/preview/preview_feed.h"
#include "runtime/preview/window_process.h"
#include "runtime/profiles/profiles_in_force.h"
#include "runtime/recordings/trace_log.h"
#include "runtime/recordings/trace_of_session.h"
#include "runtime/render/off_screen.h"
#include "runtime/render/scene_options.h"
#include "runtime/render/snapshot.h"
#include "runtime/report/lag_reasons.h"
#include "runtime/report/output_file.h"
#include "runtime/report/session_summary.h"
#include "runtime/report/summary_json.h"
#include "runtime/report/trace_account.h"
#include "runtime/run/display_mismatch.h"
#include "runtime/run/event_log.h"
#include "runtime/run/fitted_scale.h"
#include "runtime/run/govern.h"
#include "runtime/run/interrupt.h"
#include "runtime/run/loop_end_text.h"
#include "runtime/run/no_effect.h"
#include "runtime/run/no_gaze.h"
#include "runtime/run/picture_device.h"
#include "runtime/run/recording_observer.h"
#include "runtime/run/run_checks.h"
#include "runtime/run/run_header.h"
#include "runtime/run/run_monitor.h"
#include "runtime/run/run_snapshot.h"
#include "runtime/run/run_summary.h"
#include "runtime/run/run_target.h"
#include "runtime/run/run_timeline.h"
#include "runtime/run/tracker_fault.h"
#include "runtime/run/tracker_figures.h"
#include "runtime/session/replay_check.h"
#include "runtime/session/session_recorder.h"
#include "runtime/time/clock.h"
#include "runtime/time/milliseconds.h"
#include "sim/baked_light_field.h"

namespace gazeloop::run {
namespace {

class FrameRun {
  public:
    explicit FrameRun(const FrameRunRequest& request)
        : request_(request),
          values_(request.settings->values()),
          display_(display_of(request)),
          calibration_(value_or_throw(calibration::calibration_in_force(
              values_.gaze.calibration_values, *request.settings))),
          monitor_(value_or_throw(profiles::budget_in_force(values_.profile, *request.settings))) {}

    std::optional<ErrorKind> run() {
        check_request(request_);
        for (const std::string& line : without_effect(request_)) {
            spdlog::warn("{}", line);
        }
        if (request_.snapshot) {
            value_or_throw(render::make_snapshot_folder(*request_.snapshot));
        }
        if (request_.preview_eyes != 0) {
            window_ = std::make_unique<preview::WindowProcess>(request_.preview_eyes);
        }
        present::OpenXrTarget* openxr = nullptr;
        if (values_.target.name == "openxr") {
            auto target = make_openxr_target(request_, display_);
            openxr = target.get();
            target_ = std::move(target);
        } else {
            target_ = make_headless_target(request_, display_);
        }
        context_ = std::make_unique<vulkan::Context>(
            vulkan::ContextOptions{.validation = values_.vulkan.validation,
                                   .device = values_.vulkan.device,
                                   .device_origin = request_.settings->origin("vulkan.device")},
            target_->vulkan_factory());
        target_->start(*context_);
        if (request_.take_presses) {
            take_presses(openxr);
        }
        if (request_.openxr_gaze) {
            openxr_gaze_ =
                std::make_unique<drivers::OpenXrSource>(openxr->session(), *request_.openxr_gaze);
        } else if (openxr != nullptr) {
            openxr->session().attach_actions();
        }
        config_ = renderer_config();
        check_recorded_target(request_, config_);
        check_picture(request_, config_);
        scene_ = &scene_now();
        render::FrameRenderer renderer(*context_, *scene_, make_passes(values_.render.method),
                                       config_);
        spdlog::info("Vulkan: {} ({})", context_->device_name(), context_->driver());
        spdlog::info("{}x{} per eye, method {}, scene {}, {} samples, target {}",
                     config_.extents[0].width, config_.extents[0].height, values_.render.method,
                     values_.render.scene, values_.render.spp, values_.target.name);
        for (const std::string& skipped : scene_->skipped()) {
            spdlog::info("left out, since the scene does not need it: {}", skipped);
        }
        if (request_.clock == RunClock::Wall) {
            // First draws compile shaders, which must not look like a slow first frame.
            render::warm_up(*context_, renderer, profile_views(display_, target_->extents()));
        } else if (request_.clock == RunClock::Virtual) {
            // What a method refuses, it refuses before there is a recording.
            renderer.prepare(profile_views(display_, target_->extents()));
        }
        prepare_chooser();
        open_recording(renderer);
        if (!display_.assumed.empty()) {
            spdlog::info("display {}: assumed, not published: {}", display_.name,
                         fmt::join(display_.assumed, ", "));
        }

        latency::SummaryConfig config = report::summary_config(display_, loop_clock());
        config.passes = passes_of(renderer);
        config.grids = grids_of(renderer);
        latency::LatencySummary summary(config);
        monitor_.open(monitor_options(config));
        run_loop(renderer, summary);
        preview_.reset();
        window_presses_.reset();
        window_.reset();
        finish(summary);
        return failure_;
    }

  private:
    [[nodiscard]] latency::LoopClock loop_clock() const {
        if (request_.clock == RunClock::Recorded) {
            return request_.recording->session->info().header.meta.clock;
        }
        return request_.clock == RunClock::Virtual ? latency::LoopClock::Virtual
                                                   : latency::LoopClock::Wall;
    }

    [[nodiscard]] render::MakePasses make_passes(std::string_view method) const {
        return value_or_throw(
            methods::find_method(method)->passes(values_.methods, *request_.settings));
    }

    [[nodiscard]] render::RendererConfig renderer_config() const {
        return {.samples = static_cast<std::uint32_t>(values_.render.spp),
                .extents = target_->extents(),
                .format = target_->format(),
                .depth_format = target_->depth_format().value_or(vk::Format::eUndefined),
                .profile = values_.render.profile,
                .hash = request_.hash,
                .seen_depth = request_.openxr_gaze && request_.openxr_gaze->from_depth,
                .frames_in_flight = static_cast<std::uint32_t>(values_.render.frames_in_flight),
                .lp_gaussian = render::lp_gaussian_of(values_.render),
                .antialiasing = render::antialiasing_of(values_.render),
                .camera = render::camera_of(values_.render),
                .unshaded = std::nullopt};
    }

    /// That of the settings as they are now. Its files are read the first time.
    scene::Scene& scene_now() {
        std::unique_ptr<scene::Scene>& scene = scenes_[values_.render.scene];
        if (scene == nullptr) {
            scene = sim::make_scene(*context_, values_.render.scene,
                                    render::scene_options(values_.render, values_.light_field),
                                    [] { return !interrupted(); });
        }
        return *scene;
    }

    /// The subject's keys and buttons, before a gaze source attaches the session's actions.
    void take_presses(present::OpenXrTarget* openxr) {
        std::vector<present::ButtonSource*> sources;
        if (openxr != nullptr) {
            openxr_answers_ = std::make_unique<drivers::AnswerActions>(openxr->session());
            sources.push_back(openxr_answers_.get());
        }
        if (window_ != nullptr) {
            window_->memory().takes_presses = true;
            window_presses_ = std::make_unique<preview::PressedReader>(window_->memory().presses);
            sources.push_back(window_presses_.get());
        }
        request_.take_presses(std::move(sources));
    }

    void open_recording(const render::FrameRenderer& renderer) {
        if (!request_.record) {
            return;
        }
        const session::SessionHeader header =
            run_header(request_, display_, loop_clock(), *target_, *context_, passes_of(renderer),
                       grids_of(renderer));
        recorder_ = value_or_throw(session::SessionRecorder::create(
            *request_.record, header,
            request_.clock == RunClock::Wall ? session::WhenFull::Drop : session::WhenFull::Wait));
        for (const std::string& skipped : scene_->skipped()) {
            recorder_->event(time::Stamp{}, frame::kLeftOutEvent.name, skipped);
        }
        recording_ = std::make_unique<RecordingObserver>(
            *recorder_, request_.record_study ? "the study ends" : "the run goes on");
        if (request_.record_study) {
            request_.record_study(*recorder_);
        }
    }

    /// A chooser's renderers go before the device that made them, however the run ends.
    struct Release {
        void operator()(render::FrameChooser* chooser) const { chooser->release(); }
    };

    void prepare_chooser() {
        if (request_.chooser == nullptr) {
            return;
        }
        chooser_.reset(request_.chooser);
        if (auto front = governed_front(request_.settings->list())) {
            levels_.emplace(std::move(*front));
        }
        const gaze::StereoView views = profile_views(display_, target_->extents());
        const auto make = [this, views](const render::MakePasses& passes) {
            auto renderer = std::make_unique<render::FrameRenderer>(*context_, scene_now(), passes,
                                                                    renderer_config());
            if (request_.clock == RunClock::Wall) {
                render::warm_up(*context_, *renderer, views);
            } else if (request_.clock == RunClock::Virtual) {
                renderer->prepare(views);
            }
            return renderer;
        };
        request_.prepare_chooser(make, [this, views](render::FrameRenderer& renderer) {
            return request_.clock == RunClock::Wall ? frame_ms(*context_, renderer, views)
                                                    : std::nullopt;
        });
    }

    [[nodiscard]] frame::PassList passes_of(const render::FrameRenderer& renderer) const {
        return chooser_ != nullptr ? chooser_->passes() : renderer.passes();
    }
    [[nodiscard]] frame::GridList grids_of(const render::FrameRenderer& renderer) const {
        return chooser_ != nullptr ? chooser_->grids() : renderer.grids();
    }

    [[nodiscard]] RunMonitor::Options monitor_options(const latency::SummaryConfig& display) const {
        constexpr double kNsPerS = 1e9;
        return {.display = display,
                .panel = request_.monitor,
                .json_fd = request_.monitor_json,
                .window_ns = std::llround(values_.monitor.window_s * kNsPerS),
                .interval_ns = std::llround(values_.monitor.interval_s * kNsPerS)};
    }

    /// Why a replay's pictures need not be the recorded ones; empty if they must.
    [[nodiscard]] std::string why_other_pictures() const {
        return request_.same_rendering
                   ? other_renderer(request_.recording->session->info().header.device,
                                    picture_device(*context_))
                   : "the settings differ from the recorded ones";
    }

    void run_loop(render::FrameRenderer& renderer, latency::LatencySummary& summary) {
        gaze::GazeToFovea gaze(gaze::fovea_policy(values_.gaze));
        latency::SummaryObserver summing(summary);
        EventLog logging;
        report::TraceObserver tracing(trace_);
        if (request_.clock == RunClock::Recorded) {
            check_.emplace(*request_.recording->session, request_.other_foveae,
                           why_other_pictures());
            add_recorded_events(summary);
        }
        LoopParts parts{
            .target = *target_,
            .renderer = renderer,
            .gaze = gaze,
            .make_timeline =
                [this] { return run_timeline(request_, display_, target_->extents()); },
            .make_source =
                [this](std::int64_t start_ns) {
                    auto source = openxr_gaze_ != nullptr ? std::move(openxr_gaze_)
                                                          : request_.make_source(start_ns);
                    if (request_.live_gaze) {
                        source = std::make_unique<drivers::AnatomySource>(std::move(source));
                    }
                    source = calibrated(std::move(source));
                    spdlog::info("gaze: {}", source->description());
                    lag_.on_event(time::Stamp{}, frame::kGazeSourceEvent.name,
                                  source->description());
                    if (recorder_ != nullptr) {
                        recorder_->event(time::Stamp{}, frame::kGazeSourceEvent.name,
                                         source->description());
                    }
                    if (source->trace() != nullptr) {
                        tell_of_trace(*source->trace());
                    }
                    return source;
                },
            .observers = {&summing, &logging, &tracing, &lag_, &tracker_fault_},
            .chooser = chooser_.get()};
        if (request_.observer != nullptr) {
            parts.observers.push_back(request_.observer);
        }
        if (recording_ != nullptr) {
            parts.observers.push_back(recording_.get());
        }
        if (levels_) {
            parts.observers.push_back(&*levels_);
        }
        monitor_.join(parts.observers);
        if (request_.hash) {
            parts.observers.push_back(&hash_);
        }
        if (check_) {
            parts.observers.push_back(&*check_);
        }
        if (request_.make_overlay) {
            overlay_ = request_.make_overlay(*context_, config_);
            parts.observers.push_back(overlay_.get());
        }
        if (request_.snapshot) {
            snapshot_ = std::make_unique<render::Snapshot>(*context_, renderer);
            parts.observers.push_back(snapshot_.get());
        }
        open_preview(renderer);
        if (preview_ != nullptr) {
            parts.observers.push_back(preview_.get());
        }
        LoopOptions options = request_.loop;
        options.stop = [this] { return why_stop(); };
        options.hidden_area = values_.render.hidden_area;
        // What draws without the gaze would only wait.
        options.wait_before_latch = values_.render.wait_before_latch &&
                                    methods::find_method(values_.render.method)->uses_gaze;
        options.budget_ns = monitor_.budget() ? monitor_.budget()->total_ns : std::nullopt;
        try {
            result_ = run_frame_loop(parts, options);
            if (result_.end == LoopEnd::Interrupted) {
                failure_ = ErrorKind::Interrupted;
            }
            spdlog::info("{} frames, {}", result_.frames, end_text(result_.end));
            if (preview_ != nullptr) {
                spdlog::info("preview: {} frames shown, {} dropped", preview_->frames_shown(),
                             preview_->frames_dropped());
            }
            compare_with_profile(summary);
            tell_account(summary);
            if (recorder_ != nullptr) {
                recorder_->event(time::measured_now(), frame::kGpuClockEvent.name,
                                 fmt::format("related to CLOCK_MONOTONIC within {} ns",
                                             renderer.clock_deviation_ns()));
            }
        } catch (const SetupError& error) {
            fail(error.kind(), error.what());
        } catch (const vk::DeviceLostError& error) {
            fail(ErrorKind::SessionLost,
                 fmt::format("the Vulkan device was lost ({}): the kernel's log (dmesg) may say "
                             "why; start again",
                             error.what()));
        } catch (const vk::SystemError& error) {
            fail(
                ErrorKind::SessionLost,
                fmt::format("Vulkan failed ({}): use a smaller picture (--set render.scale=0.5) or "
                            "close what else uses the device",
                            error.what()));
        }
        monitor_.close();
    }

    /// What its reader found is said wherever the run is spoken of.
    void tell_of_trace(const gaze::GazeTrace& trace) {
        recordings::log_trace(trace);
        for (const std::string& text : report::trace_events(trace.report)) {
            trace_.take(frame::kTraceEvent.name, text);
            if (recorder_ != nullptr) {
                recorder_->event(time::Stamp{}, frame::kTraceEvent.name, text);
            }
        }
    }

    void open_preview(const render::FrameRenderer& renderer) {
        if (window_ == nullptr) {
            return;
        }
        preview_ = std::make_unique<preview::PreviewFeed>(
            *context_,
            preview::PreviewFeed::Options{
                .extents = config_.extents,
                .format = config_.format,
                .display = {.period_ns = display_.period_ns(),
                            .switching_ns = display_.switching_ns,
                            .rolling_ns = display_.rolling_ns()},
                .passes = passes_of(renderer),
                .ring_radius_px =
                    [&renderer](gaze::Eye eye) { return renderer.last_plan(eye).ring_px; }},
            window_->memory());
    }

    /// A preview that fails does not end the run: the headset is what counts.
    [[nodiscard]] std::optional<LoopEnd> why_stop() {
        if (interrupted()) {
            return LoopEnd::Interrupted;
        }
        if (const auto why = request_.loop.stop ? request_.loop.stop() : std::nullopt) {
            return why;
        }
        if (window_ == nullptr || window_broken_) {
            return std::nullopt;
        }
        const preview::WindowState state = window_->state();
        if (state == preview::WindowState::Broken) {
            window_broken_ = true;
            spdlog::warn("the preview's window broke (the display went away?): the run goes on");
        }
        return state == preview::WindowState::Closed ? std::optional(LoopEnd::Closed)
                                                     : std::nullopt;
    }

    /// The runtime's display counts; the profile then supplies only what the runtime cannot say.
    void compare_with_profile(latency::LatencySummary& summary) {
        const std::optional<std::string> text =
            request_.clock == RunClock::Wall
                ? display_mismatch(summary.display_period_ns().value_or(0), display_)
                : std::nullopt;
        if (!text) {
            return;
        }
        spdlog::warn("{}", *text);
        const time::Stamp now = time::measured_now();
        summary.add_event(now, frame::kDisplayEvent.name, *text);
        if (recorder_ != nullptr) {
            recorder_->event(now, frame::kDisplayEvent.name, *text);
        }
    }

    /// What the scene did over the run.
    void tell_account(latency::LatencySummary& summary) {
        const std::optional<std::string> text = scene_->account();
        if (!text) {
            return;
        }
        spdlog::info("{}: {}", values_.render.scene, *text);
        summary.add_event(time::Stamp{}, frame::kViewsEvent.name, *text);
        if (recorder_ != nullptr) {
            recorder_->event(time::Stamp{}, frame::kViewsEvent.name, *text);
        }
    }

    /// With the calibration in force, if there is one. A recorded session's gaze has been corrected
    /// already, and gaze that is fixed in the head is no tracker's.
    std::unique_ptr<drivers::GazeSource> calibrated(std::unique_ptr<drivers::GazeSource> source) {
        const bool recorded =
            request_.clock == RunClock::Recorded ||
            (source->trace() != nullptr && source->trace()->format == recordings::kSessionFormat);
        if (!calibration_ || recorded || source->fixed_in_head()) {
            return source;
        }
        return std::make_unique<drivers::CalibratedSource>(std::move(source), *calibration_);
    }

    /// What happened while it was recorded belongs to the times of a replay, which are the recorded
    /// ones.
    void add_recorded_events(latency::LatencySummary& summary) {
        session::EventCursor events(*request_.recording->session);
        while (value_or_throw(events.next())) {
            const session::RecordedEvent& event = *events.row();
            if (event.kind == frame::kLeftOutEvent.name || event.kind == frame::kViewsEvent.name) {
                continue;  // the replay's own scene says what it leaves out, and loads
            }
            summary.add_event(event.time, event.kind, event.text);
            lag_.on_event(event.time, event.kind, event.text);
        }
    }

    /// The first failure decides the exit code, also of a run that was ended by hand.
    void fail(ErrorKind kind, const std::string& message) {
        spdlog::error("{}", message);
        if (recorder_ != nullptr) {
            recorder_->event(time::measured_now(), frame::kErrorEvent.name, message);
        }
        if (!failure_ || failure_ == ErrorKind::Interrupted) {
            failure_ = kind;
        }
    }

    void finish(const latency::LatencySummary& summary) {
        if (recorder_ != nullptr) {
            const session::RecordingStatus status = recorder_->close();
            if (!status.failure.empty()) {
                fail(ErrorKind::RecordingIncomplete, status.failure);
            } else if (status.dropped > 0) {
                fail(ErrorKind::RecordingIncomplete,
                     fmt::format("{}: {} records were dropped: the disk was too slow",
                                 request_.record->string(), status.dropped));
            } else {
                spdlog::info("recorded to {}", request_.record->string());
            }
            recorder_.reset();
        }
        const latency::SummaryReport report = summary.report();
        const GazeAtEnd gaze{.source = request_.gaze,
                             .from_device = request_.from_device,
                             .by_runtime = request_.openxr_gaze.has_value(),
                             .live = request_.clock == RunClock::Wall && !result_.fixed_in_head,
                             .fault = tracker_fault_.why(),
                             .report = report};
        if (const auto why = why_no_gaze(gaze); why && failure_ != ErrorKind::Interrupted) {
            fail(ErrorKind::NoDevice, *why);
        } else if (const std::string warning = no_gaze_warning(gaze); !warning.empty()) {
            spdlog::warn("{}", warning);
        }
        if (!failure_ && report.frames.rendered == 0) {
            fail(
                ErrorKind::GateFailed,
                fmt::format("nothing was rendered: {}",
                            request_.loop.frames == 0 || request_.loop.seconds == 0.0
                                ? "ask for more --frames or --seconds"
                            : report.frames.total > 0
                                ? "the runtime asked for no picture: put the headset on, and close "
                                  "what lies over the program"
                                : "the run ended before its first frame"));
        }
        const std::vector<NamedValue> settings = request_.settings->list();
        const std::vector<NamedValue> device = picture_device(*context_);
        const auto& budget = monitor_.budget();
        const report::LagFacts facts{.report = &report,
                                     .budget = budget ? &*budget : nullptr,
                                     .origin = lag_.origin(),
                                     .prediction = latency::check_prediction(
                                         tracker_figures(settings, lag_.origin()), report),
                                     .use = lag_.use(),
                                     .smoothing = lag_.smoothing(),
                                     .unplaced = lag_.unplaced().view(),
                                     .settings = settings,
                                     .device = device};
        const RunSummary said{.report = report,
                              .reasons = report::lag_reasons(facts),
                              .prediction = facts.prediction,
                              .trace = trace_,
                              .monitor = monitor_,
                              .left_out = {scene_->skipped(), scene_->passes()},
                              .levels = levels_ ? &*levels_ : nullptr,
                              .hash = request_.hash ? &hash_ : nullptr,
                              .check = check_ ? &*check_ : nullptr,
                              .clock = request_.clock,
                              .fixed_in_head = result_.fixed_in_head};
        if (check_ && !check_->equal()) {
            fail(ErrorKind::GateFailed, "the replay differs from the recording");
        }
        // If JSON goes to stdout, nothing else does.
        std::FILE* const out = request_.json == "-" ? stderr : stdout;
        std::fputs(run_summary_text(said, request_.quiet).c_str(), out);
        if (request_.json) {
            if (const auto written =
                    report::write_text(*request_.json, report::json_text(run_summary_json(said)));
                !written) {
                fail(written.error().kind, written.error().message);
            }
        }
        take_snapshot(out);
        if (context_->validation_messages() > 0) {
            fail(ErrorKind::GateFailed,
                 fmt::format("Vulkan validation: {} messages", context_->validation_messages()));
        }
    }

    void take_snapshot(std::FILE* out) {
        if (!request_.snapshot) {
            return;
        }
        const std::string_view full = methods::all_methods().front().name;
        const auto files = write_run_snapshot({.context = *context_,
                                               .scene = *scene_,
                                               .shown = *snapshot_,
                                               .config = config_,
                                               .full = values_.render.method != full
                                                           ? std::optional(make_passes(full))
                                                           : std::nullopt,
                                               .folder = *request_.snapshot,
                                               .mark_fovea = request_.mark_fovea});
        if (!files) {
            fail(files.error().kind, files.error().message);
            return;
        }
        for (const auto& file : *files) {
            fmt::print(out, "snapshot {}\n", file.string());
        }
    }

    const FrameRunRequest& request_;
    const ProgramValues& values_;
    display::DisplayProfile display_;
    std::optional<calibration::Calibration> calibration_;
    TrackerFault tracker_fault_;
    // The target's swapchains live on the context's device: they go first.
    std::unique_ptr<vulkan::Context> context_;
    std::unique_ptr<present::FrameTarget> target_;
    std::unique_ptr<drivers::AnswerActions> openxr_answers_;
    std::unique_ptr<drivers::GazeSource> openxr_gaze_;  // of the target's session; until the loop's
    std::unique_ptr<preview::WindowProcess> window_;
    std::unique_ptr<preview::PressedReader> window_presses_;
    std::unique_ptr<preview::PreviewFeed> preview_;  // writes into the window's memory
    bool window_broken_ = false;
    render::RendererConfig config_;
    std::map<std::string, std::unique_ptr<scene::Scene>> scenes_;  ///< by render.scene
    scene::Scene* scene_ = nullptr;  ///< the run's; choosers may draw others too
    std::unique_ptr<render::FrameChooser, Release> chooser_;
    std::unique_ptr<frame::FrameObserver> overlay_;
    std::unique_ptr<render::Snapshot> snapshot_;
    std::unique_ptr<session::SessionRecorder> recorder_;
    std::unique_ptr<RecordingObserver> recording_;
    RunMonitor monitor_;
    std::optional<governor::LevelAccount> levels_;  ///< of a governed run
    report::TraceAccount trace_;
    report::LagObserver lag_;
    session::ReplayHash hash_;
    std::optional<session::ReplayCheck> check_;
    LoopResult result_;
    std::optional<ErrorKind> failure_;  ///< the first one; none: the run went well
};

}  // namespace

std::optional<ErrorKind> frame_run(const FrameRunRequest& request) {
    const CatchesInterrupts catches;
    try {
        return FrameRun(request).run();
    } catch (const vk::SystemError& error) {
        throw SetupError(
            ErrorKind::NoDevice,
            fmt::format("Vulkan failed during set-up ({}): use a smaller picture (--set "
                        "render.scale=0.5) or another device",
                        error.what()));
    }
}

}  // namespace gazeloop::run
