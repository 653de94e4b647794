#include "drivers/hid/tracker_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>
#include <utility>

#include "runtime/time/clock.h"

namespace gazeloop::drivers::hid {
namespace {

/// Reads the feature reports; one that cannot be read stays as it was. False where it was to stop.
bool read_features(HidrawDevice& device, const EyeTrackerLayout& layout, const StopRequested& stop,
                   std::vector<FeatureReport>& reports) {
    for (const std::uint8_t id : layout.feature_ids()) {
        const ReportSize* const size = find_report(layout.reports, ReportKind::Feature, id);
        if (auto bytes = device.feature(id, size->payload_bytes())) {
            std::erase_if(reports, [&](const FeatureReport& report) { return report.id == id; });
            reports.push_back({id, std::move(*bytes)});
        }
        if (stop()) {
            return false;
        }
    }
    return true;
}

/// One line for each thing that it states, and what keeps gaze from coming; all but its status.
std::vector<std::string> describe(const EyeTrackerLayout& layout, const TrackerFeatures& features,
                                  const ScreenGeometry& geometry) {
    std::vector<std::string> lines;
    if (features.status.sampling_hz) {
        lines.push_back(fmt::format("states {} Hz", *features.status.sampling_hz));
    }
    if (features.screen_width_m && features.screen_height_m) {
        lines.push_back(fmt::format("calibrated to a screen of {:.0f} x {:.0f} mm",
                                    *features.screen_width_m * 1e3,
                                    *features.screen_height_m * 1e3));
    }
    if (features.display_manufacturer && features.display_product) {
        lines.push_back(
            fmt::format("set up for the display {:04x}:{:04x} (maker and product in its EDID)",
                        *features.display_manufacturer, *features.display_product));
    }
    if (features.capability_correction != 1.0) {
        lines.push_back(fmt::format("its distances are wrong by a factor of {}: corrected",
                                    features.capability_correction));
    }
    if (features.screen_correction != 1.0) {
        lines.push_back(fmt::format("its screen's size is wrong by a factor of {}: corrected",
                                    features.screen_correction));
    }
    for (const auto& [of, metres] : features.implausible) {
        lines.push_back(
            fmt::format("states {:.3g} m as {}, which cannot be: left out", metres, of));
    }
    if (auto problem = geometry_problem(layout, geometry)) {
        lines.push_back(std::move(*problem));
    }
    return lines;
}

}  // namespace

TrackerSession::TrackerSession(std::string text, HidrawDevice device,
                               std::vector<FeatureReport> reports, const EyeTrackerLayout& layout,
                               const HidOptions& options, StopRequested stopped)
    : text_(std::move(text)),
      device_(std::move(device)),
      layout_(layout),
      configured_(options.geometry),
      stopped_(std::move(stopped)),
      reports_(std::move(reports)),
      features_(decode_features(layout_, reports_)),
      reported_(describe(layout_, features_, geometry())),
      samples_(layout_, geometry(), options.delay, features_.status.status) {
    if (features_.status.status) {
        remarks_.push_back(fmt::format("status: {}", text_of(*features_.status.status)));
    }
    remarks_.insert(remarks_.end(), reported_.begin(), reported_.end());
    if (auto start = encode_mode_request(layout_, kModeGaze | kModeEyePosition)) {
        start_ = std::move(*start);
        stop_ = encode_mode_request(layout_, kModeStop).value();
        if (const auto sent = device_.send_feature(start_); !sent) {
            refused_ = true;
            remarks_.push_back(
                fmt::format("asked to start, {}: asked again each second while no gaze comes",
                            sent.error().message));
        }
    }
}

ScreenGeometry TrackerSession::geometry() const {
    ScreenGeometry geometry = configured_;
    if (geometry.width_m <= 0.0) {
        geometry.width_m = features_.screen_width_m.value_or(0.0);
    }
    if (geometry.height_m <= 0.0) {
        geometry.height_m = features_.screen_height_m.value_or(0.0);
    }
    return geometry;
}

TrackerSession::~TrackerSession() {
    if (!stop_.empty() && device_.nobody_else_reads()) {
        [[maybe_unused]] const auto sent = device_.send_feature(stop_);  // it may have gone
    }
}

Expected<TrackerSession> TrackerSession::open(const FoundTracker& tracker,
                                              const HidOptions& options,
                                              const StopRequested& stop) {
    if (!tracker.layout) {
        return std::unexpected(
            Error{tracker.layout.error().kind,
                  fmt::format("{}: {}", tracker.device.text(), tracker.layout.error().message)});
    }
    if (tracker.device.access_problem) {
        return std::unexpected(Error{ErrorKind::NoDevice, *tracker.device.access_problem});
    }
    auto device = HidrawDevice::open(tracker.device.path);
    if (!device) {
        return std::unexpected(std::move(device.error()));
    }
    std::vector<FeatureReport> reports;
    if (!read_features(*device, *tracker.layout, stop, reports)) {
        return std::unexpected(
            Error{ErrorKind::Interrupted,
                  fmt::format("{}: interrupted while it was opened", tracker.device.text())});
    }
    HidOptions of_this = options;
    of_this.delay.polling_ns = tracker.polling_ns;
    return TrackerSession(tracker.device.text(), std::move(*device), std::move(reports),
                          *tracker.layout, of_this, stop);
}

TrackerFacts TrackerSession::facts() const {
    TrackerFacts facts;
    facts.sampling_hz = features_.status.sampling_hz;
    facts.display_manufacturer = features_.display_manufacturer;
    facts.display_product = features_.display_product;
    facts.display_serial = features_.display_serial;
    facts.screen_width_m = features_.screen_width_m;
    facts.screen_height_m = features_.screen_height_m;
    facts.quality = features_.quality;
    facts.minimum_distance_m = features_.minimum_distance_m;
    facts.optimum_distance_m = features_.optimum_distance_m;
    facts.maximum_distance_m = features_.maximum_distance_m;
    facts.maximum_screen_width_m = features_.maximum_width_m;
    facts.maximum_screen_height_m = features_.maximum_height_m;
    if (samples_.status()) {
        facts.status = text_of(*samples_.status());
    }
    return facts;
}

/// After a second without tracking data, and at most once a second. A reset, a suspension or
/// another program's end may have stopped it. No gaze is silence too for some trackers: asking one
/// that sends is harmless.
///
/// Its features are read again, once, where they may be others: it has become ready, so that the
/// screen's size and the rate may have come with its set-up, or it takes requests only now. Valid
/// gaze needs neither; but data without it do not count as sending then, because without the
/// screen's size no gaze may be valid.
void TrackerSession::ask_again(std::int64_t now_ns, DeviceFeed& feed) {
    constexpr std::int64_t kAskAfterNs = 1'000'000'000;
    const std::int64_t heard_ns = ready_ ? gaze_ns_ : tracked_ns_;
    if (now_ns - std::max(heard_ns, asked_ns_) < kAskAfterNs || (start_.empty() && !ready_)) {
        return;
    }
    const bool taken = start_.empty() || device_.send_feature(start_).has_value();
    const bool only_now = taken && std::exchange(refused_, false);
    if (only_now) {
        feed.tell(time::measured_now(), "takes the request to start now");
    }
    if (std::exchange(ready_, false) || only_now) {
        read_features_again(feed);
    }
    asked_ns_ = time::monotonic_ns();  // a device may take seconds for a request
}

void TrackerSession::read_features_again(DeviceFeed& feed) {
    if (!read_features(device_, layout_, stopped_, reports_)) {
        return;
    }
    features_ = decode_features(layout_, reports_);
    samples_.learn(geometry(), features_.status.status);
    const std::vector<std::string> before =
        std::exchange(reported_, describe(layout_, features_, geometry()));
    for (const std::string& line : reported_) {
        if (std::ranges::find(before, line) == before.end()) {
            feed.tell(time::measured_now(), line);
        }
    }
}

Expected<void> TrackerSession::read(std::chrono::milliseconds longest, DeviceFeed& feed) {
    std::array<std::uint8_t, kLongestReport + 1> report;
    const Expected<std::size_t> bytes = device_.read(report, longest);
    const std::int64_t arrived_ns = time::monotonic_ns();
    if (!bytes) {
        return std::unexpected(bytes.error());
    }
    if (*bytes > 0) {
        const auto status = samples_.status();
        if (auto sample = samples_.take({report.data(), *bytes}, arrived_ns)) {
            const bool gaze = sample->eyes[0].valid || sample->eyes[1].valid;
            gaze_ns_ = gaze ? arrived_ns : gaze_ns_;
            feed.push(*sample, samples_.lost_before_last());
        }
        tracked_ns_ = samples_.tracked_last() ? arrived_ns : tracked_ns_;
        ready_ =
            ready_ || (samples_.status() != status && samples_.status() == TrackerStatus::Ready);
    }
    ask_again(arrived_ns, feed);  // the status comes from one that was stopped, too
    if (auto change = samples_.take_change()) {
        feed.tell({arrived_ns, time::StampKind::Measured}, std::move(*change));
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
        return std::unexpected(
            Error{ErrorKind::NoDevice,
                  fmt::format("{}: {}: waiting for it", options.path, why.message())});
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
