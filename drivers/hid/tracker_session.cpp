#include "drivers/hid/tracker_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace gazeloop::drivers::hid {
namespace {

TrackerFeatures read_features(HidrawDevice& device, const EyeTrackerLayout& layout) {
    std::vector<FeatureReport> reports;
    for (const std::uint8_t id : layout.feature_ids()) {
        const ReportSize* const size = layout.report(ReportKind::Feature, id);
        if (auto bytes = device.feature(id, size->payload_bytes())) {
            reports.push_back({id, std::move(*bytes)});
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

TrackerSession::TrackerSession(HidrawDevice device, const EyeTrackerLayout& layout,
                               const HidOptions& options)
    : device_(std::move(device)),
      features_(read_features(device_, layout)),
      samples_(layout, merged(options.geometry, features_), options.delay) {
    describe(layout, merged(options.geometry, features_));
    const auto start = encode_mode_request(layout, kModeGaze | kModeEyePosition);
    if (start) {
        if (const auto sent = device_.send_feature(*start); sent) {
            stop_ = encode_mode_request(layout, kModeStop).value();
        } else {
            remarks_.push_back("asked to start, " + sent.error().message);
        }
    }
}

TrackerSession::~TrackerSession() {
    if (!stop_.empty()) {
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
    if (features_.capability_correction != 1.0) {
        remarks_.push_back(fmt::format("its distances are wrong by a factor of {}: corrected",
                                       features_.capability_correction));
    }
    if (auto problem = geometry_problem(layout, geometry)) {
        remarks_.push_back(std::move(*problem));
    }
}

Expected<TrackerSession> TrackerSession::open(const FoundTracker& tracker,
                                              const HidOptions& options) {
    if (!tracker.layout) {
        return std::unexpected(
            Error{tracker.layout.error().code,
                  fmt::format("{}: {}", tracker.text(), tracker.layout.error().message)});
    }
    if (tracker.access_problem) {
        return std::unexpected(Error{ExitCode::NoDevice, *tracker.access_problem});
    }
    auto device = HidrawDevice::open(tracker.path);
    if (!device) {
        return std::unexpected(std::move(device.error()));
    }
    return TrackerSession(std::move(*device), *tracker.layout, options);
}

const FoundTracker* chosen(const std::vector<FoundTracker>& trackers, const HidOptions& options) {
    const auto found = std::ranges::find_if(trackers, [&](const FoundTracker& tracker) {
        return options.path.empty() || tracker.path == options.path;
    });
    return found == trackers.end() ? nullptr : &*found;
}

}  // namespace gazeloop::drivers::hid
