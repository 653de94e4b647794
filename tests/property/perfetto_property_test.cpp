// Whatever the stamps of a session: its trace keeps the rules of the format, and what is not in it
// is counted.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "runtime/report/perfetto/perfetto_observer.h"
#include "tests/support/perfetto_trace.h"
#include "tests/unit/latency/example_frame.h"

namespace gazeloop::report::perfetto {
namespace {

using latency::kMs;

template <typename T>
T one_of(std::initializer_list<T> values) {
    return *rc::gen::elementOf(std::vector<T>(values));
}

/// At the ends of the range, which a disturbed time may lie at, it stays.
std::int64_t moved(std::int64_t ns, std::int64_t by_ns) {
    std::int64_t sum = 0;
    return __builtin_add_overflow(ns, by_ns, &sum) ? ns : sum;
}

/// Mostly as it should be; else some ms off, or at an end of the range, or unknown.
time::Stamp disturbed(const time::Stamp& stamp) {
    constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
    constexpr std::int64_t kGreatest = std::numeric_limits<std::int64_t>::max();
    const auto kind = static_cast<time::StampKind>(*rc::gen::inRange(1, 5));
    switch (*rc::gen::inRange(0, 12)) {
        case 0:
            return {};
        case 1:
            return {one_of({kLeast, kLeast + 1, std::int64_t{-1}, std::int64_t{0},
                            std::int64_t{1} << 62, kGreatest - 1, kGreatest}),
                    kind};
        case 2:
        case 3:
        case 4:
            return {moved(stamp.ns, *rc::gen::inRange<std::int64_t>(-40, 40) * kMs), kind};
        default:
            return stamp;
    }
}

frame::FrameRecord disturbed_frame(std::uint64_t index) {
    frame::FrameRecord frame = latency::example_frame(index);
    frame::FrameStamps& stamps = frame.stamps;
    for (time::Stamp* const stamp :
         {&stamps.wake_up, &stamps.begin, &stamps.latch, &stamps.filtered, &stamps.submit,
          &stamps.end_frame, &stamps.present, &stamps.display}) {
        *stamp = disturbed(*stamp);
    }
    frame.should_render = *rc::gen::inRange(0, 8) > 0;
    frame.period_ns = one_of<std::int64_t>(
        {latency::kExamplePeriodNs, 0, -1, 1, std::numeric_limits<std::int64_t>::max()});
    for (gaze::FoveaPoint& eye : frame.fovea.eyes) {
        eye.state = static_cast<gaze::FoveaState>(*rc::gen::inRange(0, 5));
        eye.reason = static_cast<gaze::LossReason>(*rc::gen::inRange(0, 4));
        eye.sampled = disturbed(eye.sampled);
        eye.arrived = disturbed(eye.arrived);
        eye.ready = disturbed(eye.ready);
        eye.position.y_px =
            one_of({0.0, 50.0, -1e300, 1e300, std::numeric_limits<double>::quiet_NaN()});
    }
    return frame;
}

frame::FrameGpuRecord disturbed_gpu(std::uint64_t index) {
    frame::FrameGpuRecord gpu = latency::example_gpu(index, *rc::gen::inRange<std::int64_t>(0, 60));
    gpu.gpu_begin = disturbed(gpu.gpu_begin);
    gpu.gpu_end = disturbed(gpu.gpu_end);
    for (std::size_t pass = 0; pass < 3; ++pass) {
        const auto ns = [] {
            return one_of<std::int64_t>({0, 1, kMs, 3 * kMs, -kMs,
                                         std::numeric_limits<std::int64_t>::min() + 1,
                                         std::numeric_limits<std::int64_t>::max()});
        };
        gpu.passes.set(pass, ns());
        gpu.pass_starts.set(pass, ns());
    }
    gpu.clock_deviation_ns =
        one_of<std::int64_t>({-1, 0, 1, std::numeric_limits<std::int64_t>::max()});
    return gpu;
}

PerfettoConfig some_config() {
    const auto ns = [] {
        return one_of<std::optional<std::int64_t>>(
            {std::nullopt, 0, kMs, 8 * kMs, -kMs, std::numeric_limits<std::int64_t>::max()});
    };
    PerfettoConfig config;
    config.session.clock = one_of({latency::LoopClock::Wall, latency::LoopClock::Virtual});
    config.session.period_ns = one_of<std::int64_t>({0, latency::kExamplePeriodNs});
    config.session.passes = latency::kExamplePasses;
    config.session.switching_ns = ns();
    config.session.rolling_ns = ns();
    config.session.persistence_ns = ns();
    config.samples = one_of({SampleDetail::Used, SampleDetail::All});
    return config;
}

RC_GTEST_PROP(PerfettoObserverProperty, KeepsTheRulesOfTheFormatWhateverTheStamps, ()) {
    std::string bytes;
    PerfettoObserver observer(some_config(), [&bytes](std::string_view piece) { bytes += piece; });
    std::uint64_t index = 0;
    std::uint64_t rendered = 0;
    const int frames = *rc::gen::inRange(0, 40);
    for (int i = 0; i < frames; ++i) {
        index += one_of<std::uint64_t>({1, 1, 1, 3});
        gaze::GazeSample sample;
        sample.sequence = *rc::gen::inRange<std::uint64_t>(0, 50);
        sample.arrived =
            disturbed({static_cast<std::int64_t>(index) * 10 * kMs, time::StampKind::Measured});
        observer.on_sample(sample, index);
        const frame::FrameRecord frame = disturbed_frame(index);
        observer.on_event(disturbed(frame.stamps.latch), "gaze", "left held");
        observer.on_frame(frame);
        if (*rc::gen::inRange(0, 4) > 0) {
            observer.on_gpu(disturbed_gpu(index));
        }
        rendered += frame.should_render ? 1 : 0;
    }
    observer.finish();
    const tests::PerfettoTrace trace = tests::read_perfetto(bytes);
    for (const std::string& fault : trace.faults) {
        RC_LOG() << fault << '\n';
    }
    RC_ASSERT(trace.faults.empty());
    std::uint64_t unshown = 0;
    for (std::size_t why = 0; why < kWhyUnshownTexts.size(); ++why) {
        unshown += observer.unshown().count(Subject::Photon, static_cast<WhyUnshown>(why));
    }
    RC_ASSERT(trace.named("photon").size() + unshown == rendered);
}

}  // namespace
}  // namespace gazeloop::report::perfetto
