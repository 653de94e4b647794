#include <fmt/core.h>

#include <algorithm>
#include <optional>

#include "drivers/openxr/openxr_source.h"
#include "runtime/doctor/checks.h"
#include "runtime/doctor/eye_gaze_findings.h"
#include "runtime/doctor/probe.h"
#include "runtime/error.h"
#include "runtime/present/openxr/openxr_target.h"
#include "runtime/time/clock.h"

namespace gazeloop::doctor {
namespace {

/// What came while it listened.
struct Heard {
    std::uint64_t samples = 0;
    std::uint64_t with_gaze = 0;
    std::uint64_t with_time = 0;
    double oldest_ms = 0.0;  ///< of those with a time, when they were read
};

void listen(const std::vector<gaze::GazeSample>& samples, Heard& heard) {
    for (const gaze::GazeSample& sample : samples) {
        ++heard.samples;
        heard.with_gaze += sample.eyes[0].valid || sample.eyes[1].valid ? 1 : 0;
        if (sample.sampled.known()) {
            ++heard.with_time;
            heard.oldest_ms = std::max(
                heard.oldest_ms, static_cast<double>(sample.arrived.ns - sample.sampled.ns) * 1e-6);
        }
    }
}

/// Frames without pictures, because only a session with focus gets gaze.
Heard listen_for(double seconds, present::FrameTarget& target, drivers::GazeSource& source) {
    Heard heard;
    std::vector<gaze::GazeSample> samples;
    present::TargetFrame frame;
    const std::int64_t begin_ns = time::monotonic_ns();
    while (static_cast<double>(time::monotonic_ns() - begin_ns) * 1e-9 < seconds) {
        const present::TargetState state = target.poll();
        if (state == present::TargetState::Ended) {
            break;
        }
        if (state == present::TargetState::Running) {
            target.wait_frame(frame);
            target.begin_frame();
            samples.clear();
            source.poll(time::monotonic_ns(), samples);
            listen(samples, heard);
            target.end_frame(frame, false);
        }
    }
    return heard;
}

Finding samples_finding(const Heard& heard, double seconds) {
    const double rate_hz = static_cast<double>(heard.samples) / seconds;
    std::string found = fmt::format(
        "{} samples in {:.1f} s ({:.1f} Hz, read once a frame), gaze in "
        "{}, time in {}",
        heard.samples, seconds, rate_hz, heard.with_gaze, heard.with_time);
    if (heard.with_time > 0) {
        found += fmt::format(", at most {:.1f} ms old when read", heard.oldest_ms);
    }
    return {.check = "openxr.eye_gaze.samples",
            .verdict = heard.with_gaze > 0 ? Verdict::Ok : Verdict::Warning,
            .found = std::move(found),
            .facts = {{"seconds", seconds},
                      {"samples", heard.samples},
                      {"samples_with_gaze", heard.with_gaze},
                      {"samples_with_time", heard.with_time}}};
}

void probe_eye_gaze(const OpenXrChecks& asked, double seconds, ProbeReport& report) {
    const auto tell = [&report](const drivers::GazeGates& gates) {
        for (const Finding& finding : eye_gaze_findings(gates)) {
            report.add(finding);
        }
    };
    report.step("setting up an OpenXR session");
    std::optional<vulkan::Context> context;  // outlives what the target makes on it
    const auto target = present::make_openxr_target({.display = asked.display,
                                                     .scale = asked.scale,
                                                     .extensions = {drivers::kEyeGazeExtension}});
    report.add({.check = "openxr.eye_gaze.runtime",
                .found = target->instance().runtime_name(),
                .facts = {{"runtime", target->instance().runtime_name()},
                          {"system", target->instance().system_name()}}});
    drivers::GazeGates gates;
    const openxr::Instance& instance = target->instance();
    if (!drivers::check_instance_gates(instance.handle(), instance.system(),
                                       instance.has(drivers::kEyeGazeExtension), gates)) {
        tell(gates);
        return;
    }
    context.emplace(vulkan::ContextOptions{}, target->vulkan_factory());
    target->start(*context);
    report.step("listening to the eye gaze");
    drivers::OpenXrSource source(target->session(), {});
    const Heard heard = listen_for(seconds, *target, source);
    tell(source.gates());
    report.add(samples_finding(heard, seconds));
}

}  // namespace

Findings check_eye_gaze(const OpenXrChecks& asked, double seconds, const ProbeLimits& limits) {
    return run_probe([&](ProbeReport& report) { probe_eye_gaze(asked, seconds, report); }, limits)
        .findings_and_end("openxr.eye_gaze.session", "gazeloop doctor says what the runtime lacks",
                          false);
}

}  // namespace gazeloop::doctor
