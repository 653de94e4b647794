#include "drivers/trace/clock/host_times.h"

#include <fmt/format.h>

#include <utility>

#include "drivers/trace/clock/clock_chain.h"
#include "drivers/trace/clock/time_text.h"
#include "runtime/memory/long_vector.h"

namespace gazeloop::drivers {
namespace {

using gaze::TraceFindingKind;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

class Choosing {
  public:
    Choosing(const ClockPair& clocks, std::span<const std::uint64_t> lines)
        : clocks_(clocks), lines_(lines) {}

    HostTimes run() {
        for (std::size_t i = 0; i < clocks_.host_ns.size(); ++i) {
            if (clocks_.host_ns[i]) {
                used_.push_back(i);
            }
        }
        leave_out_standing();
        leave_out_outliers();
        found_.rows = std::move(used_);
        return std::move(found_);
    }

  private:
    /// Host times that stay the same while the device's clock goes on say nothing, but for the
    /// first. Where reports waited and were read all at once, the last of them is in time.
    void leave_out_standing() {
        memory::LongVector<std::size_t> left;
        const auto end_of_run = [&](std::size_t from) {
            std::size_t end = from;
            while (end < used_.size() &&
                   clocks_.host_ns[used_[end]] == clocks_.host_ns[used_[from]]) {
                ++end;
            }
            return end;
        };
        for (std::size_t i = 0; i < used_.size();) {
            const std::size_t end = end_of_run(i);
            const std::size_t first = used_[i];
            const std::size_t last = used_[end - 1];
            const std::int64_t over_ns =
                clocks_.device.time_ns[last] - clocks_.device.time_ns[first];
            bool stood = over_ns > clocks_.jitter_ns();
            if (stood && !left.empty()) {
                stood = clocks_.excess(left.back(), last) < -static_cast<Wide>(clocks_.jitter_ns());
            } else if (stood && end < used_.size()) {
                stood = clocks_.excess(last, used_[end_of_run(end) - 1]) > clocks_.jitter_ns();
            }
            if (stood) {
                left.push_back(first);
                report_stand(first, end - i, over_ns);
            } else {
                left.insert(left.end(), used_.begin() + static_cast<std::ptrdiff_t>(i),
                            used_.begin() + static_cast<std::ptrdiff_t>(end));
            }
            i = end;
        }
        used_ = std::move(left);
    }

    void report_stand(std::size_t row, std::size_t count, std::int64_t over_ns) {
        found_.stood = true;
        found_.findings.push_back(
            {.kind = TraceFindingKind::ClockStoodStill,
             .line = lines_[row],
             .rows = count,
             .dropped = 0,
             .span_ns = over_ns,
             .text = fmt::format("the host's clock stood still for {}, {} rows of one host time: "
                                 "they go by the device's clock, and how long they took to the "
                                 "host is unknown",
                                 in_words(over_ns), count)});
    }

    void leave_out_outliers() {
        constexpr Wide kDay_ns = Wide{86'400} * kSecond_ns;
        const ClockSteps steps{
            .joins =
                [&](std::size_t before, std::size_t after) {
                    const Wide more = clocks_.excess(used_[before], used_[after]);
                    return more >= -clocks_.jitter_ns() && more <= clocks_.jitter_ns();
                },
            .doubt =
                [&](std::size_t before, std::size_t after) {
                    const bool impossible = clocks_.elapsed(used_[before], used_[after]) <
                                                -static_cast<Wide>(clocks_.jitter_ns()) ||
                                            clocks_.excess(used_[before], used_[after]) > kDay_ns;
                    return impossible ? kImpossibleStep : 0.0;
                },
        };
        memory::LongVector<bool> kept = readings_in_step(used_.size(), steps);
        constexpr std::size_t kFewest = 16;
        constexpr std::int64_t kLatest_ns = 10 * kSecond_ns;
        if (used_.size() >= kFewest) {
            kept.front() = kept.front() && clocks_.excess(used_[0], used_[1]) <= kLatest_ns;
            kept.back() = kept.back() && clocks_.excess(used_[used_.size() - 2],
                                                        used_[used_.size() - 1]) <= kLatest_ns;
        }
        memory::LongVector<std::size_t> left;
        for (std::size_t i = 0; i < used_.size(); ++i) {
            if (kept[i]) {
                left.push_back(used_[i]);
                continue;
            }
            std::size_t end = i + 1;
            while (end < used_.size() && !kept[end]) {
                ++end;
            }
            report_outliers(used_[i], end - i);
            i = end - 1;
        }
        used_ = std::move(left);
    }

    void report_outliers(std::size_t row, std::size_t count) {
        found_.outliers += count;
        found_.findings.push_back(
            {.kind = TraceFindingKind::HostTimeOutlier,
             .line = lines_[row],
             .rows = count,
             .dropped = 0,
             .span_ns = 0,
             .text = fmt::format("{} that no neighbour agrees with: left out, and how long {} took "
                                 "to the host is unknown",
                                 count == 1 ? "a host time" : "host times",
                                 count == 1 ? "the report" : "these reports")});
    }

    const ClockPair& clocks_;
    std::span<const std::uint64_t> lines_;
    memory::LongVector<std::size_t> used_;
    HostTimes found_;
};

}  // namespace

HostTimes host_times(const ClockPair& clocks, std::span<const std::uint64_t> lines) {
    return Choosing(clocks, lines).run();
}

}  // namespace gazeloop::drivers
