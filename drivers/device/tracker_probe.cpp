#include "drivers/device/tracker_probe.h"

#include <utility>

#include "drivers/device/silence.h"
#include "runtime/time/clock.h"

namespace gazeloop::drivers {
namespace {

/// Samples whose directions are held against anatomy: ten seconds of a fast tracker.
constexpr std::size_t kJudged = 10'000;

}  // namespace

TrackerProbe probe_tracker(const TrackerSupport& support, const FoundDevice& device,
                           const OpenTracker& open, std::chrono::milliseconds listen,
                           const StopRequested& stop) {
    TrackerProbe probe;
    probe.support = support;
    probe.device = device;
    const auto tracker = open(stop);
    if (!tracker || *tracker == nullptr) {
        probe.problem = tracker ? device.path + " was unplugged" : tracker.error().message;
        return probe;
    }
    probe.remarks = (*tracker)->remarks();

    DeviceFeed feed;
    std::vector<gaze::GazeSample> samples;
    gaze::AnatomyCheck anatomy(kJudged);
    std::optional<std::int64_t> first_ns;
    std::int64_t last_ns = 0;
    const std::int64_t begin_ns = time::monotonic_ns();
    const std::int64_t end_ns =
        begin_ns + std::chrono::duration_cast<std::chrono::nanoseconds>(listen).count();
    // What it does not answer is part of what is wrong with it.
    while ((time::monotonic_ns() < end_ns || (*tracker)->asking()) && !stop() && !probe.problem) {
        if (const auto read = (*tracker)->read(kLongestRead, feed); !read) {
            probe.problem = read.error().message;
        }
        samples.clear();
        feed.poll(samples);
        for (const gaze::GazeSample& sample : samples) {
            first_ns = first_ns.value_or(sample.arrived.ns);
            last_ns = sample.arrived.ns;
            anatomy.add(sample);
            probe.with_gaze += sample.eyes[0].valid || sample.eyes[1].valid ? 1 : 0;
        }
        for (SourceEvent& event : feed.take_events()) {
            if (!event.text.starts_with("clock")) {  // its verdict is that of the end
                probe.remarks.push_back(std::move(event.text));
            }
        }
    }
    probe.seconds = static_cast<double>(time::monotonic_ns() - begin_ns) * 1e-9;
    probe.facts = (*tracker)->facts();
    probe.counts = (*tracker)->counts();
    if (!probe.problem) {
        probe.silence = silence_text(probe.counts, probe.seconds, (*tracker)->why_silent());
    }
    probe.pupils_mm = (*tracker)->pupils_mm();
    if (probe.counts.samples > 1 && last_ns > *first_ns) {
        probe.rate_hz = static_cast<double>(probe.counts.samples - 1) * 1e9 /
                        static_cast<double>(last_ns - *first_ns);
    }
    if (probe.with_gaze > 0) {
        probe.anatomy = anatomy.judge();
    }
    if (const time::ClockFit* const clock = (*tracker)->clock()) {
        probe.clock = *clock;
    }
    return probe;
}

}  // namespace gazeloop::drivers
