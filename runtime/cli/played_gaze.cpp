#include "runtime/cli/played_gaze.h"

#include "drivers/trace/axes_correction.h"
#include "drivers/trace/read_trace.h"
#include "runtime/recordings/trace_log.h"
#include "runtime/run/interrupt.h"
#include "runtime/time/clock.h"
#include "sim/gaze_generator.h"

namespace gazeloop::cli {
namespace {

/// Simulated gaze repeats after this.
constexpr double kLap_s = 60.0;

}  // namespace

void PlayedGaze::add_to(Command command) {
    command.option("--trace", trace, "what it sees; without: simulated gaze").type("FILE");
    command.option("--axes", axes, "turn the trace's directions")
        .one_of({drivers::kAxesCorrectionNames.begin(), drivers::kAxesCorrectionNames.end()});
    command.flag("--accept-repairs", read.accept_repairs,
                 "read a trace of which much was dropped or changed");
    command.option("--seconds", seconds, "end after S seconds (until interrupted)")
        .number_between(0.0, 1e9);
    command.option("--rate", gaze.tracker.rate_hz, "samples per second, Hz")
        .number_between(1.0, 1e4);
    command.option("--seed", gaze.seed, "the same seed gives the same gaze");
    log.add_to(command);
}

gaze::GazeTrace PlayedGaze::samples() const {
    if (trace.empty()) {
        return sim::generate_gaze(gaze, kLap_s);
    }
    drivers::ReadOptions options = read;
    options.axes = drivers::axes_correction_named(axes);
    gaze::GazeTrace samples = value_or_throw(drivers::read_trace(trace, options));
    recordings::log_trace(samples);
    return samples;
}

void PlayedGaze::play(
    const gaze::GazeTrace& seen, std::int64_t begin_ns,
    const std::function<void(std::int64_t due_ns)>& wait,
    const std::function<void(const gaze::GazeSample&, std::int64_t taken_ns)>& send) const {
    constexpr std::int64_t kBetweenLaps_ns = 10'000'000;
    const auto over = [&] {
        return run::interrupted() ||
               static_cast<double>(time::monotonic_ns() - begin_ns) * 1e-9 > seconds;
    };
    for (std::int64_t lap_ns = begin_ns; !over();
         lap_ns += seen.samples.back().sampled.ns + kBetweenLaps_ns) {
        for (const gaze::GazeSample& sample : seen.samples) {
            const std::int64_t taken_ns = lap_ns + sample.sampled.ns;
            wait(taken_ns);
            if (over()) {
                return;
            }
            send(sample, taken_ns);
        }
    }
}

}  // namespace gazeloop::cli
