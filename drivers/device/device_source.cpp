#include "drivers/device/device_source.h"

#include <fmt/format.h>
#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <thread>
#include <utility>

#include "drivers/device/silence.h"
#include "drivers/device/udev.h"
#include "runtime/time/clock.h"

namespace gazeloop::drivers {
namespace {

using std::chrono::milliseconds;

/// A tracker may become accessible without an event (a changed permission).
constexpr milliseconds kLookAgainAfter{1000};
/// A tracker that is there but fails is not asked again at once.
constexpr milliseconds kRetryAfter{200};
/// Nor often where it fails before it gave a sample: after twice the time of before, up to this.
constexpr milliseconds kLongestRetry{5000};
/// A tracker that gives no sample for so long after it was opened is told to be silent.
constexpr milliseconds kSilentAfter{5000};

}  // namespace

class DeviceSource::Reader {
  public:
    explicit Reader(DeviceKind kind)
        : kind_(std::move(kind)),
          wake_fd_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
          watch_(kind_.subsystem),
          thread_([this] { run(); }) {
        pthread_setname_np(thread_.native_handle(), kind_.thread_name.c_str());
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
        std::string told;
        while (!stopped()) {
            try {
                look(told);
            } catch (const std::exception& error) {
                // The loop and its recording go on without this tracker.
                feed_.push_loss(time::measured_now());
                tell_once(told, fmt::format("reading the tracker failed: {}", error.what()),
                          frame::kTrackerFaultEvent);
                let_settle();
            }
        }
    }

    void look(std::string& told) {
        auto tracker = kind_.open([this] { return stopped(); });
        if (stopped()) {
            return;
        }
        milliseconds pause = kLookAgainAfter;
        if (!tracker) {
            tell_once(told, tracker.error().message, frame::kTrackerFaultEvent);
            pause = kRetryAfter;
        } else if (*tracker == nullptr) {
            tell_once(told, kind_.absence, frame::kTrackerEvent);
            failures_ = 0;
        } else {
            told.clear();
            failures_ = read(**tracker) ? 0 : failures_ + 1;
            tracker->reset();
            let_settle();
            if (failures_ < 2) {
                return;
            }
            pause = kLongestRetry;
            if (constexpr std::uint32_t kDoublings = 5; failures_ < kDoublings) {
                pause = std::min(pause, kRetryAfter * (1 << failures_));
            }
        }
        watch_.wait(pause, wake_fd_);
    }

    /// After a loss, the node may stay for a moment, and events of its arrival may still be queued.
    /// Neither means that it was plugged in again.
    void let_settle() const {
        pollfd wake{.fd = wake_fd_, .events = POLLIN, .revents = 0};
        ::poll(&wake, 1, static_cast<int>(kRetryAfter.count()));
    }

    void tell_once(std::string& told, const std::string& text, const frame::EventKind& kind) {
        if (told != text) {
            told = text;
            feed_.tell(time::measured_now(), text, kind);
        }
    }

    /// Reads until the device is gone; whether it gave a sample. One that failed before without is
    /// not told again until it does, or stays.
    bool read(TrackerDevice& tracker) {
        const std::uint64_t before = feed_.last_sequence();
        const auto gave = [&] { return feed_.last_sequence() != before; };
        const std::int64_t begin_ns = time::measured_now().ns;
        const auto stays = [&] {
            return time::measured_now().ns - begin_ns >
                   std::chrono::nanoseconds(kLookAgainAfter).count();
        };
        bool greeted = false;
        const auto greet = [&] {
            greeted = true;
            feed_.tell(time::measured_now(), "plugged in: " + tracker.text());
            const std::optional<std::string> missing = tracker.facts().missing;
            for (const std::string& remark : tracker.remarks()) {
                feed_.tell(time::measured_now(), remark,
                           remark == missing ? frame::kUnplacedGazeEvent : frame::kTrackerEvent);
            }
        };
        if (failures_ == 0) {
            greet();
        }
        bool silence_told = false;
        while (!stopped()) {
            const auto read = tracker.read(kLongestRead, feed_);
            if (greeted && read && !silence_told) {
                silence_told = tell_silence(tracker, begin_ns);
            }
            if (!greeted && read && (gave() || stays())) {
                greet();
            }
            if (!read) {
                const time::Stamp now = time::measured_now();
                const bool any = gave();
                if (greeted) {
                    feed_.push_loss(now);
                    feed_.tell(now, "gone: " + read.error().message);
                } else if (failures_ == 1) {
                    feed_.tell(now, fmt::format("{} failed again before it gave a sample: it is "
                                                "tried less and less often",
                                                tracker.text()));
                }
                return any;
            }
        }
        return true;
    }

    /// Says that it gives no sample, if it has not for kSilentAfter; true once there is no more to
    /// say.
    bool tell_silence(const TrackerDevice& tracker, std::int64_t begin_ns) {
        const time::Stamp now = time::measured_now();
        const std::int64_t silent_ns = now.ns - begin_ns;
        const auto text = silence_text(tracker.counts(), static_cast<double>(silent_ns) * 1e-9,
                                       tracker.why_silent());
        const bool long_enough = silent_ns >= std::chrono::nanoseconds(kSilentAfter).count();
        if (text && long_enough) {
            feed_.tell(now, *text);
        }
        return !text || long_enough;
    }

    DeviceKind kind_;
    DeviceFeed feed_;
    std::atomic<bool> stop_{false};
    int wake_fd_;
    std::uint32_t failures_ = 0;  ///< in a row, of a device that gave no sample
    /// Made before the first look at the devices, so that none arrives unseen. Made by the thread
    /// that makes the readers, because libudev 252 sets up a hash key at its first use without a
    /// lock: two readers that begin at once could find a device without its properties.
    DeviceWatch watch_;
    std::thread thread_;  // last: it uses the others
};

DeviceSource::DeviceSource(DeviceKind kind) : reader_(std::make_unique<Reader>(std::move(kind))) {}

DeviceSource::~DeviceSource() = default;

void DeviceSource::poll(std::int64_t /*now_ns*/, std::vector<gaze::GazeSample>& samples) {
    reader_->feed().poll(samples);
}

std::vector<SourceEvent> DeviceSource::take_events() {
    std::vector<SourceEvent> events = reader_->feed().take_events();
    if (const std::uint64_t dropped = this->dropped(); dropped != dropped_told_) {
        events.push_back({time::measured_now(),
                          fmt::format("{} samples dropped: the loop did not ask for seconds",
                                      dropped - std::exchange(dropped_told_, dropped))});
    }
    return events;
}

std::uint64_t DeviceSource::dropped() const { return reader_->feed().dropped(); }

}  // namespace gazeloop::drivers
