#include <fcntl.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>

#include "runtime/frame/frame_record.h"
#include "runtime/run/monitor_feed.h"
#include "runtime/time/clock.h"
#include "tests/bench/bench.h"

namespace gazeloop::bench {
namespace {

constexpr const char* kBench = "monitor";
constexpr std::int64_t kMs = 1'000'000;

struct Case {
    const char* name;
    double window_s;
    double rate_hz;
};

double percentile(std::vector<double> values, double share) {
    std::ranges::sort(values);
    const auto rank =
        static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
    return values[std::max<std::size_t>(rank, 1) - 1];
}

/// A frame whose stages are all known and differ from frame to frame, so that every window moves.
std::pair<frame::FrameRecord, frame::FrameGpuRecord> frame_of(std::uint64_t index,
                                                              std::int64_t period_ns,
                                                              std::mt19937_64& random) {
    std::int64_t at_ns = static_cast<std::int64_t>(index) * period_ns;
    const auto next = [&](std::int64_t least_ns) {
        at_ns += least_ns + static_cast<std::int64_t>(random() % 1'000'000);
        return time::Stamp{at_ns, time::StampKind::Measured};
    };
    frame::FrameRecord frame;
    frame.index = index;
    frame.period_ns = period_ns;
    frame.stamps.wake_up = {at_ns, time::StampKind::Measured};
    frame.stamps.begin = frame.stamps.wake_up;
    for (gaze::FoveaPoint& eye : frame.fovea.eyes) {
        eye.state = gaze::FoveaState::Tracking;
        eye.sampled = {at_ns - 7 * kMs, time::StampKind::Profile};
        eye.ready = {at_ns - 3 * kMs, time::StampKind::Measured};
        eye.arrived = {at_ns - kMs, time::StampKind::Measured};
        eye.position.y_px = static_cast<double>(random() % 1440);
    }
    for (gaze::EyeView& view : frame.views) {
        view.height_px = 1440;
    }
    frame.stamps.latch = next(0);
    frame.stamps.filtered = next(0);
    frame.stamps.submit = next(0);
    frame.stamps.end_frame = frame.stamps.submit;
    frame::FrameGpuRecord gpu;
    gpu.index = index;
    gpu.gpu_begin = frame.stamps.submit;
    gpu.gpu_end = next(2 * kMs);
    frame.stamps.display = next(kMs);
    frame.stamps.display.kind = time::StampKind::Predicted;
    return {frame, gpu};
}

void add_case(const Case& at, const Options& options, std::vector<Figure>& figures) {
    const auto period_ns = std::llround(1e9 / at.rate_hz);
    const auto in_window = static_cast<std::size_t>(at.window_s * at.rate_hz);
    const std::size_t measured = 5000;
    const int fd = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (fd < 0) {
        throw std::runtime_error("/dev/null cannot be opened");
    }
    std::vector<double> p50_us;
    std::vector<double> p99_us;
    for (unsigned round = 0; round < options.rounds; ++round) {
        std::mt19937_64 random(round);
        latency::LatencyBudget budget{.name = "bench", .description = {}, .source = {}};
        budget.total_ns = 14 * kMs;
        budget.stages_ns.fill(13 * kMs);
        run::MonitorOutput output(
            {.panel = false, .json_fd = fd, .budget = budget, .clock = "wall"});
        run::MonitorFeed feed(
            {.display = {.period_ns = period_ns, .switching_ns = kMs, .rolling_ns = 9 * kMs},
             .budget = budget,
             .window_ns = std::llround(at.window_s * 1e9),
             .interval_ns = 1'000'000'000,
             .output = &output});
        std::vector<double> spent_us;
        for (std::uint64_t index = 0; index < in_window + measured; ++index) {
            const auto [frame, gpu] = frame_of(index, period_ns, random);
            const std::int64_t begin_ns = time::monotonic_ns();
            feed.on_frame(frame);
            feed.on_gpu(gpu);
            const std::int64_t end_ns = time::monotonic_ns();
            if (index >= in_window) {
                spent_us.push_back(static_cast<double>(end_ns - begin_ns) * 1e-3);
            }
        }
        p50_us.push_back(percentile(spent_us, 0.5));
        p99_us.push_back(percentile(spent_us, 0.99));
    }
    close(fd);
    figures.push_back(
        {kBench, at.name, "a frame, p50", median(p50_us), "us", "lower", std::nullopt, 10.0});
    figures.push_back(
        {kBench, at.name, "a frame, p99", median(p99_us), "us", "lower", std::nullopt, 10.0});
}

/// Two readings of the clock, which every figure has in it: no monitor is cheaper.
double clock_us() {
    std::vector<double> spent_us;
    for (int i = 0; i < 10'000; ++i) {
        const std::int64_t begin_ns = time::monotonic_ns();
        spent_us.push_back(static_cast<double>(time::monotonic_ns() - begin_ns) * 1e-3);
    }
    return median(spent_us);
}

}  // namespace

std::vector<Figure> monitor(const Options& options) {
    constexpr std::array kCases{Case{"5 s at 90 Hz", 5.0, 90.0}, Case{"30 s at 90 Hz", 30.0, 90.0},
                                Case{"30 s at 120 Hz", 30.0, 120.0}};
    std::vector<Figure> figures;
    for (const Case& at : kCases) {
        if (options.wants(at.name)) {
            add_case(at, options, figures);
        }
    }
    const double bound_us = clock_us();
    for (Figure& figure : figures) {
        figure.bound = bound_us;
    }
    return figures;
}

}  // namespace gazeloop::bench
