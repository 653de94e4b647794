#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <functional>
#include <span>
#include <stdexcept>
#include <thread>

#include "drivers/device/device_feed.h"
#include "drivers/hid/hid_source.h"
#include "runtime/session/session_file.h"
#include "runtime/time/clock.h"
#include "sim/gaze_generator.h"
#include "sim/virtual_tracker.h"
#include "tests/bench/bench.h"
#include "tests/device/emulated_tracker.h"
#include "tests/device/thread_time.h"
#include "tests/support/run_program.h"

namespace gazeloop::bench {
namespace {

constexpr const char* kBench = "devices";
constexpr const char* kReading = "1000 Hz";
constexpr const char* kEmulatedReading = "1000 Hz, umockdev";
constexpr const char* kLosses = "60 s beside the loop";
constexpr std::uint16_t kRate_hz = 1000;
constexpr std::int64_t kPeriod_ns = 1'000'000'000 / kRate_hz;

/// Hands over so many reports, one a period. Gives how many were not taken.
int send_each_period(int reports, const std::function<bool(std::span<const std::uint8_t>)>& take) {
    gaze::GazeSample sample;
    for (gaze::EyeRay& ray : sample.eyes) {
        ray.valid = true;
    }
    int refused = 0;
    const std::int64_t begin_ns = time::monotonic_ns();
    for (int i = 0; i < reports; ++i) {
        time::sleep_until_ns(begin_ns + i * kPeriod_ns);
        const auto time_us = static_cast<std::uint64_t>(i * kPeriod_ns / 1000);
        refused += take(sim::virtual_tracker_report(sample, time_us)) ? 0 : 1;
    }
    return refused;
}

/// A tracker of 1000 Hz that is plugged in.
class FastTracker {
  public:
    FastTracker() : tracker_(descriptor()) {
        if (!tracker_.possible()) {
            throw std::runtime_error("not under umockdev's preload library");
        }
        for (const std::uint8_t id : std::initializer_list<std::uint8_t>{0x11, 0x12, 0x13}) {
            tracker_.set_feature(id, *sim::virtual_tracker_feature(id, kRate_hz));
        }
        tracker_.plug_in();
    }

    /// Gives how many reports found the queue full, and were lost as a device loses them.
    int send(int reports) {
        return send_each_period(reports, [this](std::span<const std::uint8_t> report) {
            return tracker_.try_send(report);
        });
    }

  private:
    static std::vector<std::uint8_t> descriptor() {
        const auto bytes = sim::virtual_tracker_descriptor();
        return {bytes.begin(), bytes.end()};
    }

    tests::EmulatedTracker tracker_;
};

/// The smallest value that the share of all values does not exceed. Precondition: not empty.
double percentile(std::vector<double> values, double share) {
    std::ranges::sort(values);
    return values[std::min(values.size() - 1,
                           static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

void wait_until_open(drivers::hid::HidSource& source) {
    for (int i = 0; i < 10'000; ++i) {
        for (const drivers::SourceEvent& event : source.take_events()) {
            if (event.text.starts_with("plugged in")) {
                return;
            }
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    throw std::runtime_error("the emulated tracker was not found");
}

/// What the reading thread does with each report, on a plain pipe of packets: umockdev would put
/// two more messages and a thread of its own into every read.
void add_reading(std::vector<Figure>& figures) {
    constexpr int kReports = 10'000;
    using namespace drivers::hid;
    const auto descriptor = sim::virtual_tracker_descriptor();
    const auto layout =
        value_or_throw(find_eye_tracker(value_or_throw(parse_report_descriptor(descriptor))));
    TrackerSamples decoder(layout, {}, {});
    drivers::DeviceFeed feed;
    std::array<int, 2> packets{};
    if (pipe2(packets.data(), O_DIRECT | O_CLOEXEC) != 0) {
        throw std::runtime_error("no pipe of packets");
    }
    std::vector<double> published_us;
    published_us.reserve(kReports);
    double spent_s = 0.0;
    std::thread reader([&] {
        std::array<std::uint8_t, kLongestReport + 1> report;
        pollfd file{packets[0], POLLIN, 0};
        while (poll(&file, 1, -1) > 0) {
            const ssize_t bytes = read(packets[0], report.data(), report.size());
            const std::int64_t arrived_ns = time::monotonic_ns();
            if (bytes <= 0) {
                break;  // the sender has closed it
            }
            if (auto sample =
                    decoder.take({report.data(), static_cast<std::size_t>(bytes)}, arrived_ns)) {
                feed.push(*sample, decoder.lost_before_last());
                published_us.push_back(static_cast<double>(time::monotonic_ns() - arrived_ns) *
                                       1e-3);
            }
        }
        timespec spent{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &spent);
        spent_s = static_cast<double>(spent.tv_sec) + static_cast<double>(spent.tv_nsec) * 1e-9;
    });
    std::vector<gaze::GazeSample> samples;
    send_each_period(kReports, [&](std::span<const std::uint8_t> report) {
        samples.clear();
        feed.poll(samples);
        return write(packets[1], report.data(), report.size()) ==
               static_cast<ssize_t>(report.size());
    });
    close(packets[1]);
    reader.join();
    close(packets[0]);
    const auto add = [&](const char* metric, double value, const char* unit,
                         std::optional<double> target) {
        figures.push_back({kBench, kReading, metric, value, unit, "lower", std::nullopt, target});
    };
    add("arrival to published, p50", percentile(published_us, 0.5), "us", std::nullopt);
    add("arrival to published, p99", percentile(published_us, 0.99), "us", 50.0);
    // Three to five times as much where the reader is woken on another core than its sender's, in a
    // virtual machine, whatever the scheduling class: under `chrt` too, unless both are pinned to
    // one.
    add("reader, of a core", 100.0 * spent_s * kRate_hz / kReports, "%", 2.0);
}

/// The reading thread itself, with all that umockdev makes of a read in it.
void add_emulated_reading(std::vector<Figure>& figures) {
    constexpr int kReports = 10'000;
    FastTracker tracker;
    drivers::hid::HidSource source({});
    wait_until_open(source);
    const double before_s = tests::thread_seconds(drivers::hid::kHidThreadName);
    (void)tracker.send(kReports);
    const double spent_s = tests::thread_seconds(drivers::hid::kHidThreadName) - before_s;
    figures.push_back({kBench, kEmulatedReading, "reader, of a core",
                       100.0 * spent_s * kRate_hz / kReports, "%", "lower"});
}

/// A minute beside a loop that renders as much as the machine can.
void add_losses(std::vector<Figure>& figures) {
    constexpr int kReports = 60'000;
    FastTracker tracker;
    const tests::ScratchFolder folder;
    const std::string recording = folder.file("session.gaze");
    int refused = 0;
    std::thread sender;
    tests::ProgramOptions options;
    options.timeout = std::chrono::seconds(300);
    options.trigger = "plugged in";
    options.on_trigger = [&](int) {
        sender = std::thread([&] { refused = tracker.send(kReports); });
    };
    const tests::ProgramResult result =
        tests::run_gazeloop({"run", "--gaze", "hid", "--target", "headless", "--seconds", "70",
                             "--set", "render.scale=0.25", "--record", recording},
                            options);
    if (sender.joinable()) {
        sender.join();
    }
    if (result.exit_code != 0) {
        throw std::runtime_error(result.err);
    }
    const auto session = value_or_throw(session::read_session(recording));
    const auto received = std::ranges::count_if(
        session.samples, [](const auto& recorded) { return recorded.sample.eyes[0].valid; });
    const auto add = [&](const char* metric, double value, std::optional<double> target) {
        figures.push_back({kBench, kLosses, metric, value, "", "lower", std::nullopt, target});
    };
    add("reports lost of 60,000", static_cast<double>(kReports - received), 0.0);
    add("of them by a full queue", refused, 0.0);
}

}  // namespace

std::vector<Figure> devices(const Options& options) {
    std::vector<Figure> figures;
    if (options.wants(kReading)) {
        add_reading(figures);
    }
    if (options.wants(kEmulatedReading)) {
        add_emulated_reading(figures);
    }
    if (options.wants(kLosses)) {
        add_losses(figures);
    }
    return figures;
}

}  // namespace gazeloop::bench
