#include "runtime/simulate/played_gaze.h"

#include "drivers/trace/read_trace.h"
#include "runtime/recordings/trace_log.h"
#include "runtime/time/clock.h"
#include "sim/gaze_generator.h"

namespace gazeloop::simulate {
namespace {

/// Simulated gaze repeats after this.
constexpr double kLap_s = 60.0;

}  // namespace

gaze::GazeTrace PlayedGaze::samples() const {
    if (trace.empty()) {
        return sim::generate_gaze(gaze, kLap_s);
    }
    gaze::GazeTrace samples = value_or_throw(drivers::read_trace(trace, read));
    recordings::log_trace(samples);
    return samples;
}

void PlayedGaze::play(
    const gaze::GazeTrace& seen, std::int64_t begin_ns, const Interrupted& interrupted,
    const std::function<void(std::int64_t due_ns)>& wait,
    const std::function<void(const gaze::GazeSample&, std::int64_t taken_ns)>& send) const {
    constexpr std::int64_t kBetweenLaps_ns = 10'000'000;
    const auto over = [&] {
        return interrupted() ||
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

}  // namespace gazeloop::simulate
