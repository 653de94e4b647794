#include "drivers/steam_frame/eye_service.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "drivers/steam_frame/poll_times.h"
#include "drivers/steam_frame/shared_file.h"
#include "runtime/time/clock.h"
#include "runtime/time/span.h"

namespace gazeloop::drivers::steam_frame {
namespace {

/// After so long without a sample the path is looked at, which may be another file by now.
constexpr std::int64_t kLookAtPath_ns = 200'000'000;
/// Longer than any blink or hiccup: the user is told.
constexpr std::int64_t kSilence_ns = 1'000'000'000;

class EyeService final : public TrackerDevice {
  public:
    EyeService(SharedFile file, const Layout& layout, std::uint32_t counter,
               const SteamFrameOptions& options)
        : file_(std::move(file)),
          layout_(layout),
          known_counter_(counter),
          text_(fmt::format("Steam Frame's eye service at {}", options.file)),
          remarks_{fmt::format("layout of version {} (build {}), {}", layout.version, layout.build,
                               options.rays == Rays::Filtered
                                   ? "gaze fused and filtered by the service"
                                   : "gaze of each eye before fusion")},
          samples_(options.delay, options.rays),
          last_sample_ns_(time::monotonic_ns()) {}

    [[nodiscard]] const std::string& text() const override { return text_; }
    [[nodiscard]] const std::vector<std::string>& remarks() const override { return remarks_; }

    [[nodiscard]] Expected<void> read(std::chrono::milliseconds longest,
                                      DeviceFeed& feed) override {
        const std::int64_t end_ns =
            time::monotonic_ns() + std::chrono::nanoseconds(longest).count();
        for (;;) {
            time::sleep_until_ns(std::min(poll_times_.next_ns(), end_ns));
            const std::int64_t now_ns = time::monotonic_ns();
            if (now_ns >= poll_times_.next_ns()) {
                const auto found = look(now_ns, feed);
                if (!found) {
                    return std::unexpected(found.error());
                }
                if (*found) {
                    return {};
                }
            }
            if (now_ns >= end_ns) {
                return {};
            }
        }
    }

    [[nodiscard]] TrackerCounts counts() const override { return samples_.counts(); }
    [[nodiscard]] std::string_view why_silent() const override {
        return "the headset may be off the head, or its eye tracking switched off";
    }
    [[nodiscard]] const time::ClockFit* clock() const override {
        return samples_.counts().samples > 0 ? &samples_.fit() : nullptr;
    }

  private:
    /// Whether there was a new sample.
    Expected<bool> look(std::int64_t now_ns, DeviceFeed& feed) {
        Image image{};
        const std::uint64_t torn_before = torn_;
        const auto fresh = read_new(file_, layout_, known_counter_, kSettle_ns, image, torn_);
        if (!fresh) {
            return std::unexpected(fresh.error());
        }
        if (torn_ != torn_before && torn_before == 0) {
            feed.tell(time::measured_now(),
                      "a sample was read while it was written: it is read again, such reads count "
                      "for nothing");
        }
        const GazeRecord record = decode_record(record_in(image, layout_));
        // A counter that is ahead of its record: the rest is still to come.
        const bool complete = *fresh && record.time_s != last_time_s_;
        if (!complete) {
            poll_times_.missed(now_ns);
            return watch_silence(now_ns, feed);
        }
        const Header header = decode_header(image);
        if (header.version != layout_.version || !header.initialised) {
            return std::unexpected(
                Error{ErrorKind::NoDevice, "the eye service has begun to make its file anew"});
        }
        take(record, header.counter, feed);
        return true;
    }

    void take(const GazeRecord& record, std::uint32_t counter, DeviceFeed& feed) {
        const ClockPair pair = read_clocks();
        const std::int64_t arrived_ns = time::monotonic_ns();
        known_counter_ = counter;
        last_time_s_ = record.time_s;
        gaze::GazeSample sample = samples_.take(record, counter, arrived_ns, pair);
        feed.push(sample, samples_.lost_before_last());
        while (const auto change = samples_.take_change()) {
            feed.tell(sample.arrived, *change);
        }
        if (std::exchange(silent_, false)) {
            feed.tell(sample.arrived,
                      fmt::format("samples come again, after {:.1f} s",
                                  static_cast<double>(arrived_ns - last_sample_ns_) * 1e-9));
        }
        last_sample_ns_ = arrived_ns;
        const time::Span age = time::between(sample.sampled, sample.arrived);
        poll_times_.found(arrived_ns, samples_.period_ns(),
                          age.known() ? std::optional(age.ns) : std::nullopt);
    }

    Expected<bool> watch_silence(std::int64_t now_ns, DeviceFeed& feed) {
        const std::int64_t silent_ns = now_ns - last_sample_ns_;
        if (silent_ns < kLookAtPath_ns || now_ns < next_look_ns_) {
            return false;
        }
        next_look_ns_ = now_ns + kLookAtPath_ns;
        if (const auto gone = file_.why_gone()) {
            return std::unexpected(Error{ErrorKind::NoDevice, *gone});
        }
        if (silent_ns >= kSilence_ns && samples_.counts().samples > 0 &&
            !std::exchange(silent_, true)) {
            feed.tell({now_ns, time::StampKind::Measured},
                      fmt::format("no sample for {:.1f} s: {}",
                                  static_cast<double>(silent_ns) * 1e-9, why_silent()));
        }
        return false;
    }

    SharedFile file_;
    Layout layout_;
    std::uint32_t known_counter_;
    std::string text_;
    std::vector<std::string> remarks_;
    GazeSamples samples_;
    PollTimes poll_times_;
    std::optional<double> last_time_s_;
    std::int64_t last_sample_ns_;
    std::int64_t next_look_ns_ = 0;
    bool silent_ = false;
    std::uint64_t torn_ = 0;
};

}  // namespace

std::vector<FoundDevice> find_services(const SteamFrameOptions& options) {
    std::error_code error;
    if (!std::filesystem::exists(options.file, error)) {
        return {};
    }
    FoundDevice service;
    service.path = options.file;
    service.name = "Steam Frame's eye service";
    return {service};
}

Expected<std::unique_ptr<TrackerDevice>> open_service(const SteamFrameOptions& options) {
    auto file = SharedFile::open(options.file);
    if (!file) {
        return std::unexpected(std::move(file.error()));
    }
    if (!*file) {
        return nullptr;
    }
    Image image{};
    if (auto read = (*file)->read(image); !read) {
        return std::unexpected(std::move(read.error()));
    }
    const Header header = decode_header(image);
    const auto layout = layout_of(header);
    if (!layout) {
        return std::unexpected(layout.error());
    }
    return std::make_unique<EyeService>(std::move(**file), *layout, header.counter, options);
}

std::vector<TrackerProbe> probe_services(const SteamFrameOptions& options,
                                         std::chrono::milliseconds listen,
                                         const StopRequested& stop) {
    std::vector<TrackerProbe> probes;
    for (const FoundDevice& found : find_services(options)) {
        probes.push_back(probe_tracker(
            kSupport, found, [&](const StopRequested&) { return open_service(options); }, listen,
            stop));
    }
    return probes;
}

}  // namespace gazeloop::drivers::steam_frame
