#include "drivers/hid/hid_source.h"

#include <fmt/format.h>
#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <thread>
#include <utility>

#include "drivers/device/device_feed.h"
#include "drivers/device/udev.h"
#include "runtime/latency/clock.h"

namespace gazeloop::drivers::hid {
namespace {

using std::chrono::milliseconds;

/// How long the end of the program may wait for a silent tracker.
constexpr milliseconds kReadFor{50};
/// A tracker may become accessible without an event (a changed permission).
constexpr milliseconds kLookAgainAfter{1000};
/// A tracker that is there but fails is not asked again at once.
constexpr milliseconds kRetryAfter{200};

}  // namespace

class HidSource::Reader {
  public:
    explicit Reader(HidOptions options)
        : options_(std::move(options)),
          wake_fd_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
          thread_([this] { run(); }) {
        pthread_setname_np(thread_.native_handle(), kHidThreadName);
    }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    ~Reader() {
        stop_.store(true, std::memory_order_relaxed);
        eventfd_write(wake_fd_, 1);
        thread_.join();
        close(wake_fd_);
    }

    [[nodiscard]] DeviceFeed& feed() { return feed_; }

  private:
    [[nodiscard]] bool stopped() const { return stop_.load(std::memory_order_relaxed); }

    void run() {
        DeviceWatch watch("hidraw");  // before the first look, so that nothing comes unseen
        std::string told;
        while (!stopped()) {
            const std::vector<FoundTracker> trackers = find_trackers();
            const FoundTracker* const tracker = chosen(trackers, options_);
            milliseconds pause = kLookAgainAfter;
            bool lost = false;
            if (tracker == nullptr) {
                tell_once(told, options_.path.empty()
                                    ? "no HID eye tracker is plugged in: waiting for one"
                                    : options_.path + " is no HID eye tracker: waiting for one");
            } else if (auto session = TrackerSession::open(*tracker, options_); !session) {
                tell_once(told, session.error().message);
                pause = kRetryAfter;
            } else {
                told.clear();
                read(*tracker, *session);
                lost = true;
            }
            if (lost) {
                let_settle();
                continue;
            }
            if (!stopped()) {
                watch.wait(pause, wake_fd_);
            }
        }
    }

    /// After a loss the node may be there for a moment longer, and events of its coming may still
    /// wait: neither is a reason to take it for plugged in again.
    void let_settle() const {
        pollfd wake{.fd = wake_fd_, .events = POLLIN, .revents = 0};
        ::poll(&wake, 1, static_cast<int>(kRetryAfter.count()));
    }

    void tell_once(std::string& told, const std::string& text) {
        if (told != text) {
            told = text;
            feed_.tell(latency::measured_now(), text);
        }
    }

    void read(const FoundTracker& tracker, TrackerSession& session) {
        feed_.tell(latency::measured_now(), "plugged in: " + tracker.text());
        for (const std::string& remark : session.remarks()) {
            feed_.tell(latency::measured_now(), remark);
        }
        std::array<std::uint8_t, kLongestReport + 1> report{};
        while (!stopped()) {
            const Expected<std::size_t> bytes = session.device().read(report, kReadFor);
            const std::int64_t arrived_ns = latency::monotonic_ns();
            if (!bytes) {
                feed_.push_loss({arrived_ns, latency::StampKind::Measured});
                feed_.tell({arrived_ns, latency::StampKind::Measured},
                           "gone: " + bytes.error().message);
                return;
            }
            if (*bytes > 0) {
                take(session.samples(), {report.data(), *bytes}, arrived_ns);
            }
        }
    }

    void take(TrackerSamples& samples, std::span<const std::uint8_t> report,
              std::int64_t arrived_ns) {
        if (auto sample = samples.take(report, arrived_ns)) {
            feed_.push(*sample, samples.lost_before_last());
        }
        if (auto change = samples.take_change()) {
            feed_.tell({arrived_ns, latency::StampKind::Measured}, std::move(*change));
        }
    }

    HidOptions options_;
    DeviceFeed feed_;
    std::atomic<bool> stop_{false};
    int wake_fd_;
    std::thread thread_;  // last: it uses the others
};

HidSource::HidSource(const HidOptions& options)
    : path_(options.path), reader_(std::make_unique<Reader>(options)) {}

HidSource::~HidSource() = default;

void HidSource::poll(std::int64_t /*now_ns*/, std::vector<gaze::GazeSample>& samples) {
    reader_->feed().poll(samples);
}

std::vector<SourceEvent> HidSource::take_events() { return reader_->feed().take_events(); }

std::uint64_t HidSource::dropped() const { return reader_->feed().dropped(); }

std::string HidSource::description() const {
    return "HID eye tracker (usage page 0x12)" + (path_.empty() ? "" : " at " + path_);
}

}  // namespace gazeloop::drivers::hid
