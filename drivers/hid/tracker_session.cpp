#include "drivers/hid/tracker_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <future>
#include <iterator>
#include <system_error>
#include <utility>

#include "runtime/time/clock.h"

namespace gazeloop::drivers::hid {
namespace {

constexpr std::int64_t kAskAfter_ns = 1'000'000'000;
/// Of one that does not answer, which takes seconds each time.
constexpr std::int64_t kAskUnanswered_ns = 60'000'000'000;

/// One line for each thing that it states; all but its status.
std::vector<std::string> describe(const TrackerFeatures& features) {
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
    return lines;
}

}  // namespace

TrackerSession::TrackerSession(std::string text, HidrawDevice device,
                               const EyeTrackerLayout& layout, const HidOptions& options,
                               StopRequested stopped)
    : text_(std::move(text)),
      device_(std::make_unique<HidrawDevice>(std::move(device))),
      layout_(layout),
      configured_(options.geometry),
      ask_after_ns_(kAskAfter_ns),
      samples_(layout_, geometry(), options.delay),
      requests_(std::make_unique<FeatureRequests>(*device_, std::move(stopped))) {
    if (auto start = encode_mode_request(layout_, kModeGaze | kModeEyePosition)) {
        start_ = std::move(*start);
        stop_ = encode_mode_request(layout_, kModeStop).value();
    }
    ask(true, true);
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
    if (!requests_) {
        return;  // moved from
    }
    requests_->end();
    std::vector<std::string> untold;
    for (const FeatureRequests::Outcome& outcome : requests_->take()) {
        if (outcome.sent) {
            take_start(outcome, untold);
        }
    }
    if (started_ && device_->nobody_else_reads()) {
        [[maybe_unused]] const auto sent = device_->send_feature(stop_);  // it may have gone
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
    HidOptions of_this = options;
    of_this.delay.polling_ns = tracker.polling_ns;
    TrackerSession session(tracker.device.text(), std::move(*device), *tracker.layout, of_this,
                           stop);
    const auto until = std::chrono::steady_clock::now() + kPatience;
    while (!session.requests_->done(kLongestRead) && !stop() &&
           std::chrono::steady_clock::now() < until) {
    }
    if (stop()) {
        return std::unexpected(
            Error{ErrorKind::Interrupted,
                  fmt::format("{}: interrupted while it was opened", tracker.device.text())});
    }
    std::vector<std::string> lines = session.take_answers();
    if (auto status = session.samples_.take_change()) {
        session.remarks_.push_back(std::move(*status));
    }
    std::ranges::move(lines, std::back_inserter(session.remarks_));
    return session;
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
    facts.unanswered_reports = unanswered_;
    facts.missing = told_problem_;
    if (samples_.status()) {
        facts.status = text_of(*samples_.status());
    }
    return facts;
}

std::string_view TrackerSession::why_silent() const {
    return "it may be off, not worn, see no eyes or want its maker's calibration; or it sends less "
           "than its descriptor declares, which Linux keeps back (dmesg may say so)";
}

void TrackerSession::ask(bool start, bool features) {
    std::vector<FeatureRequests::Request> requests;
    if (start && !start_.empty()) {
        requests.push_back({.id = start_.front(), .sent = start_});
    }
    for (const std::uint8_t id : layout_.feature_ids()) {
        if (features && std::ranges::find(unanswered_, id) == unanswered_.end()) {
            const ReportSize* const size = find_report(layout_.reports, ReportKind::Feature, id);
            requests.push_back({.id = id, .payload_bytes = size->payload_bytes(), .sent = {}});
        }
    }
    requests_->make(std::move(requests));
    asking_ = true;
}

/// After a second without tracking data, and at most once a second. A reset, a suspension or
/// another program's end may have stopped it. No gaze is silence too for some trackers: asking one
/// that sends is harmless.
///
/// Its features are read again, once, where they may be others: it has become ready, so that the
/// screen's size and the rate may have come with its set-up, or it takes requests only now. Valid
/// gaze needs neither; but data without it do not count as sending then, because without the
/// screen's size no gaze may be valid.
void TrackerSession::ask_again(std::int64_t now_ns) {
    const std::int64_t heard_ns = ready_ ? gaze_ns_ : tracked_ns_;
    if (!asking_ && now_ns - std::max(heard_ns, asked_ns_) >= ask_after_ns_ &&
        (!start_.empty() || ready_)) {
        ask(true, std::exchange(ready_, false));
    }
}

std::vector<std::string> TrackerSession::take_answers() {
    std::vector<std::string> lines;
    const bool all = requests_->done();  // before they are taken, so that none is left
    const bool refused = refused_;
    bool any_feature = false;
    for (FeatureRequests::Outcome& outcome : requests_->take()) {
        if (outcome.sent) {
            take_start(outcome, lines);
            continue;
        }
        if (outcome.answer) {
            any_feature = true;
            std::erase_if(reports_,
                          [&](const FeatureReport& report) { return report.id == outcome.id; });
            reports_.push_back({outcome.id, std::move(*outcome.answer)});
            continue;
        }
        const RequestFailure& failure = outcome.answer.error();
        if (failure.why != RequestFailure::Why::Refused) {
            unanswered_.push_back(outcome.id);
            lines.push_back(
                failure.why == RequestFailure::Why::Unanswered
                    ? fmt::format("feature report {:#04x}: no answer in {:.0f} s; going on without",
                                  outcome.id, failure.seconds)
                    : fmt::format("feature report {:#04x}: not asked for, as {} requests before it "
                                  "got no answer; going on without",
                                  outcome.id, FeatureRequests::kMostUnanswered));
        }
    }
    if (any_feature) {
        learn_features(lines);
    }
    if (all) {
        asking_ = false;
        asked_ns_ = time::monotonic_ns();
        auto problem = geometry_problem(layout_, geometry());
        if (problem && problem != told_problem_) {
            lines.push_back(*problem);
        }
        told_problem_ = std::move(problem);
    }
    if (refused && !refused_) {
        read_again_ = true;  // it takes requests only now
    }
    if (all && std::exchange(read_again_, false)) {
        ask(false, true);
    }
    return lines;
}

void TrackerSession::take_start(const FeatureRequests::Outcome& outcome,
                                std::vector<std::string>& lines) {
    const bool was_refused = refused_;
    refused_ = !outcome.answer.has_value();
    if (!refused_) {
        started_ = true;
        ask_after_ns_ = kAskAfter_ns;
        if (was_refused) {
            lines.emplace_back("takes the request to start now");
        }
        return;
    }
    // One that does not answer will not answer to a stop either, and nobody is to wait for that.
    const RequestFailure& failure = outcome.answer.error();
    const bool unanswered = failure.why != RequestFailure::Why::Refused;
    started_ = started_ || !unanswered;
    ask_after_ns_ = unanswered ? kAskUnanswered_ns : kAskAfter_ns;
    if (!was_refused) {
        lines.push_back(
            unanswered ? fmt::format("request to start, feature report {:#04x}: no answer in "
                                     "{:.0f} s; going on without",
                                     outcome.id, failure.seconds)
                       : fmt::format("request to start, feature report {:#04x}: does not take the "
                                     "request: asked again each second while no gaze comes",
                                     outcome.id));
    }
}

void TrackerSession::learn_features(std::vector<std::string>& lines) {
    features_ = decode_features(layout_, reports_);
    samples_.learn(geometry(), features_.status.status);
    const std::vector<std::string> before = std::exchange(reported_, describe(features_));
    std::ranges::copy_if(reported_, std::back_inserter(lines), [&](const std::string& line) {
        return std::ranges::find(before, line) == before.end();
    });
}

Expected<void> TrackerSession::read(std::chrono::milliseconds longest, DeviceFeed& feed) {
    std::array<std::uint8_t, kLongestReport + 1> report;
    const Expected<std::size_t> bytes = device_->read(report, longest);
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
    if (asking_) {
        for (std::string& line : take_answers()) {
            const bool unplaced = line == told_problem_;
            feed.tell(time::measured_now(), std::move(line),
                      unplaced ? frame::kUnplacedGazeEvent : frame::kTrackerEvent);
        }
    }
    ask_again(arrived_ns);  // the status comes from one that was stopped, too
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

std::vector<TrackerProbe> probe_trackers(const std::vector<FoundTracker>& trackers,
                                         const HidOptions& options,
                                         std::chrono::milliseconds listen,
                                         const StopRequested& stop) {
    std::vector<std::future<TrackerProbe>> listening;
    listening.reserve(trackers.size());
    for (const FoundTracker& tracker : trackers) {
        listening.push_back(std::async(std::launch::async, [&] {
            return probe_tracker(
                kSupport, tracker.device,
                [&](const StopRequested& stopped) { return opened(tracker, options, stopped); },
                listen, stop);
        }));
    }
    std::vector<TrackerProbe> probes;
    probes.reserve(listening.size());
    for (std::future<TrackerProbe>& probe : listening) {
        probes.push_back(probe.get());
    }
    return probes;
}

}  // namespace gazeloop::drivers::hid
