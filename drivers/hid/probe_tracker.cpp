#include "drivers/hid/probe_tracker.h"

#include <array>

#include "runtime/latency/clock.h"

namespace gazeloop::drivers::hid {

TrackerProbe probe_tracker(const FoundTracker& tracker, const HidOptions& options,
                           std::chrono::milliseconds listen, const std::function<bool()>& stop) {
    constexpr std::chrono::milliseconds kReadFor{50};
    TrackerProbe probe;
    probe.tracker = tracker;
    auto session = TrackerSession::open(tracker, options);
    if (!session) {
        probe.problem = session.error().message;
        return probe;
    }
    probe.features = session->features();
    probe.remarks = session->remarks();

    std::array<std::uint8_t, kLongestReport + 1> report{};
    TrackerSamples& samples = session->samples();
    const std::int64_t begin_ns = latency::monotonic_ns();
    const std::int64_t end_ns =
        begin_ns + std::chrono::duration_cast<std::chrono::nanoseconds>(listen).count();
    std::optional<std::int64_t> first_ns;
    std::int64_t last_ns = begin_ns;
    while (latency::monotonic_ns() < end_ns && !stop()) {
        const auto bytes = session->device().read(report, kReadFor);
        const std::int64_t arrived_ns = latency::monotonic_ns();
        if (!bytes) {
            probe.problem = bytes.error().message;
            break;
        }
        if (const auto sample = samples.take({report.data(), *bytes}, arrived_ns)) {
            first_ns = first_ns.value_or(arrived_ns);
            last_ns = arrived_ns;
            probe.with_gaze += sample->eyes[0].valid || sample->eyes[1].valid ? 1 : 0;
        }
        if (auto change = samples.take_change(); change && change->starts_with("status")) {
            probe.remarks.push_back(std::move(*change));
        }
    }
    probe.seconds = static_cast<double>(latency::monotonic_ns() - begin_ns) * 1e-9;
    probe.counts = samples.counts();
    if (probe.counts.samples > 1 && last_ns > *first_ns) {
        probe.rate_hz = static_cast<double>(probe.counts.samples - 1) * 1e9 /
                        static_cast<double>(last_ns - *first_ns);
    }
    if (const latency::ClockFit* const clock = samples.clock()) {
        probe.clock = describe(*clock);
    }
    return probe;
}

}  // namespace gazeloop::drivers::hid
