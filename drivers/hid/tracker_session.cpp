#include "drivers/hid/tracker_session.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <system_error>
#include <utility>

#include "runtime/latency/clock.h"

namespace gazeloop::drivers::hid {
namespace {

/// None where it was to stop.
std::optional<TrackerFeatures> read_features(HidrawDevice& device, const EyeTrackerLayout& layout,
                                             const StopRequested& stop) {
    std::vector<FeatureReport> reports;
    for (const std::uint8_t id : layout.feature_ids()) {
        const ReportSize* const size = find_report(layout.reports, ReportKind::Feature, id);
        if (auto bytes = device.feature(id, size->payload_bytes())) {
            reports.push_back({id, std::move(*bytes)});
        }
        if (stop()) {
            return std::nullopt;
        }
    }
    return decode_features(layout, reports);
}

ScreenGeometry merged(const ScreenGeometry& configured, const TrackerFeatures& features) {
    ScreenGeometry geometry = configured;
    if (geometry.width_m <= 0.0) {
        geometry.width_m = features.screen_width_m.value_or(0.0);
    }
    if (geometry.height_m <= 0.0) {
        geometry.height_m = features.screen_height_m.value_or(0.0);
    }
    return geometry;
}

}  // namespace

TrackerSession::TrackerSession(std::string text, HidrawDevice device,
                               const TrackerFeatures& features, const EyeTrackerLayout& layout,
                               const HidOptions& options)
    : text_(std::move(text)),
      device_(std::move(device)),
      features_(features),
      samples_(layout, merged(options.geometry, features_), options.delay,
               features_.status.status) {
    describe(layout, merged(options.geometry, features_));
    if (auto start = encode_mode_request(layout, kModeGaze | kModeEyePosition)) {
        if (const auto sent = device_.send_feature(*start); sent) {
            start_ = std::move(*start);
            stop_ = encode_mode_request(layout, kModeStop).value();
        } else {
            remarks_.push_back("asked to start, " + sent.error().message);
        }
    }
}

TrackerSession::~TrackerSession() {
    if (!stop_.empty() && device_.nobody_else_reads()) {
        [[maybe_unused]] const auto sent = device_.send_feature(stop_);  // it may have gone
    }
}

void TrackerSession::describe(const EyeTrackerLayout& layout, const ScreenGeometry& geometry) {
    if (features_.status.status) {
        remarks_.push_back(fmt::format("status: {}", text_of(*features_.status.status)));
    }
    if (features_.status.sampling_hz) {
        remarks_.push_back(fmt::format("states {} Hz", *features_.status.sampling_hz));
    }
    if (features_.screen_width_m && features_.screen_height_m) {
        remarks_.push_back(fmt::format("calibrated to a screen of {:.0f} x {:.0f} mm",
                                       *features_.screen_width_m * 1e3,
                                       *features_.screen_height_m * 1e3));
    }
    if (features_.display_manufacturer && features_.display_product) {
        remarks_.push_back(
            fmt::format("set up for the display {:04x}:{:04x} (maker and product in its EDID)",
                        *features_.display_manufacturer, *features_.display_product));
    }
    if (features_.capability_correction != 1.0) {
        remarks_.push_back(fmt::format("its distances are wrong by a factor of {}: corrected",
                                       features_.capability_correction));
    }
    if (features_.screen_correction != 1.0) {
        remarks_.push_back(fmt::format("its screen's size is wrong by a factor of {}: corrected",
                                       features_.screen_correction));
    }
    for (const auto& [of, metres] : features_.implausible) {
        remarks_.push_back(
            fmt::format("states {:.3g} m as {}, which cannot be: left out", metres, of));
    }
    if (auto problem = geometry_problem(layout, geometry)) {
        remarks_.push_back(std::move(*problem));
    }
}

Expected<TrackerSession> TrackerSession::open(const FoundTracker& tracker,
                                              const HidOptions& options,
                                              const StopRequested& stop) {
    if (!tracker.layout) {
        return std::unexpected(
            Error{tracker.layout.error().code,
                  fmt::format("{}: {}", tracker.device.text(), tracker.layout.error().message)});
    }
    if (tracker.device.access_problem) {
        return std::unexpected(Error{ExitCode::NoDevice, *tracker.device.access_problem});
    }
    auto device = HidrawDevice::open(tracker.device.path);
    if (!device) {
        return std::unexpected(std::move(device.error()));
    }
    auto features = read_features(*device, *tracker.layout, stop);
    if (!features) {
        return std::unexpected(
            Error{ExitCode::Interrupted,
                  fmt::format("{}: interrupted while it was opened", tracker.device.text())});
    }
    HidOptions of_this = options;
    of_this.delay.polling_ns = tracker.polling_ns;
    return TrackerSession(tracker.device.text(), std::move(*device), *features, *tracker.layout,
                          of_this);
}

TrackerFacts TrackerSession::facts() const {
    TrackerFacts facts;
    facts.sampling_hz = features_.status.sampling_hz;
    facts.display_manufacturer = features_.display_manufacturer;
    facts.display_product = features_.display_product;
    facts.display_serial = features_.display_serial;
    facts.screen_width_m = features_.screen_width_m;
    facts.screen_height_m = features_.screen_height_m;
    facts.minimum_distance_m = features_.minimum_distance_m;
    facts.optimum_distance_m = features_.optimum_distance_m;
    facts.maximum_distance_m = features_.maximum_distance_m;
    if (features_.status.status) {
        facts.status = text_of(*features_.status.status);
    }
    return facts;
}

/// A reset, a suspension or another program's end may have stopped it. No gaze is silence too for
/// some trackers: asking one that sends is harmless.
void TrackerSession::ask_again(std::int64_t now_ns) {
    constexpr std::int64_t kAskAfterNs = 1'000'000'000;
    if (start_.empty() || now_ns - last_heard_ns_ < kAskAfterNs) {
        return;
    }
    last_heard_ns_ = now_ns;
    [[maybe_unused]] const auto sent = device_.send_feature(start_);  // it may be going
}

Expected<void> TrackerSession::read(std::chrono::milliseconds longest, DeviceFeed& feed) {
    std::array<std::uint8_t, kLongestReport + 1> report;
    const Expected<std::size_t> bytes = device_.read(report, longest);
    const std::int64_t arrived_ns = latency::monotonic_ns();
    if (!bytes) {
        return std::unexpected(bytes.error());
    }
    if (*bytes == 0) {
        ask_again(arrived_ns);
        return {};
    }
    if (auto sample = samples_.take({report.data(), *bytes}, arrived_ns)) {
        feed.push(*sample, samples_.lost_before_last());
    }
    if (samples_.tracked_last()) {
        last_heard_ns_ = arrived_ns;
    } else {
        ask_again(arrived_ns);  // its status comes from a stopped one, too
    }
    if (auto change = samples_.take_change()) {
        feed.tell({arrived_ns, latency::StampKind::Measured}, std::move(*change));
    }
    return {};
}

namespace {

Expected<std::unique_ptr<TrackerDevice>> opened(const FoundTracker& tracker,
                                                const HidOptions& options,
                                                const StopRequested& stop) {
    auto session = TrackerSession::open(tracker, options, stop);
    if (!session) {
        return std::unexpected(std::move(session.error()));
    }
    return std::make_unique<TrackerSession>(std::move(*session));
}

}  // namespace

Expected<std::unique_ptr<TrackerDevice>> open_tracker(const HidOptions& options,
                                                      const StopRequested& stop) {
    // A rule of udev's may have given the node another name as well.
    std::error_code why;
    const std::string node =
        options.path.empty() ? "" : std::filesystem::canonical(options.path, why).string();
    if (why) {
        return std::unexpected(Error{ExitCode::NoDevice, fmt::format("{}: {}: waiting for it",
                                                                     options.path, why.message())});
    }
    // The first that can be used; if none can, why the first cannot.
    std::optional<Error> first_error;
    for (const FoundTracker& tracker : find_trackers()) {
        if (!options.path.empty() && tracker.device.path != node) {
            continue;
        }
        auto session = opened(tracker, options, stop);
        if (session || stop()) {
            return session;
        }
        if (!first_error) {
            first_error = std::move(session.error());
        }
    }
    if (first_error) {
        return std::unexpected(std::move(*first_error));
    }
    return nullptr;
}

std::vector<TrackerProbe> probe_trackers(const HidOptions& options,
                                         std::chrono::milliseconds listen,
                                         const StopRequested& stop) {
    std::vector<TrackerProbe> probes;
    for (const FoundTracker& tracker : find_trackers()) {
        probes.push_back(probe_tracker(
            kSupport, tracker.device,
            [&](const StopRequested& stopped) { return opened(tracker, options, stopped); }, listen,
            stop));
    }
    return probes;
}

}  // namespace gazeloop::drivers::hid
