#include "runtime/report/monitor_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "runtime/time/milliseconds.h"

namespace gazeloop::report {
namespace {

using latency::MonitorPart;
using latency::MonitorSnapshot;

constexpr std::string_view kRed = "\x1b[31m";
constexpr std::string_view kGreen = "\x1b[32m";
constexpr std::string_view kYellow = "\x1b[33m";
constexpr std::string_view kBold = "\x1b[1m";
constexpr std::string_view kPlain = "\x1b[0m";

double milliseconds(std::int64_t ns) { return static_cast<double>(ns) / time::kNsPerMs; }

/// At most six characters.
std::string figure(const std::optional<std::int64_t>& ns) {
    if (!ns) {
        return "-";
    }
    for (const int decimals : {2, 0}) {
        const std::string text = fmt::format("{:.{}f}", milliseconds(*ns), decimals);
        if (text.size() <= 6) {
            return text;
        }
    }
    return fmt::format("{:.0e}", milliseconds(*ns));
}

/// "24 fr, 286 ms".
std::string longest_run(const MonitorPart& part) {
    if (part.violations == 0) {
        return {};
    }
    const double ms = milliseconds(part.longest_run_ns);
    return fmt::format(
        "{} fr, {}", part.longest_run_frames,
        ms < 999.5 ? fmt::format("{:.0f} ms", ms) : fmt::format("{:.1f} s", ms / 1e3));
}

std::string count(std::uint64_t value) {
    return value <= 99'999 ? fmt::format("{}", value)
                           : fmt::format("{:.0e}", static_cast<double>(value));
}

std::string percent(std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? "-"
                      : fmt::format("{:.0f} %",
                                    100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

std::string states(const MonitorSnapshot& snapshot) {
    std::string text;
    for (std::size_t state = 0; state < snapshot.by_state.size(); ++state) {
        if (snapshot.by_state[state] > 0) {
            fmt::format_to(std::back_inserter(text), "{}{} {}", text.empty() ? "" : ", ",
                           gaze::kFoveaStateNames[state],
                           percent(snapshot.by_state[state], snapshot.window_frames));
        }
    }
    return text.empty() ? "none yet" : text;
}

std::string shares(const MonitorSnapshot& snapshot) {
    if (!snapshot.share_by_kind_percent) {
        return "eye-to-photon unknown";
    }
    std::string text = "eye-to-photon";
    for (const time::StampKind kind :
         {time::StampKind::Measured, time::StampKind::Profile, time::StampKind::Modelled,
          time::StampKind::Predicted, time::StampKind::Unknown}) {
        const double share = (*snapshot.share_by_kind_percent)[static_cast<std::size_t>(kind)];
        if (share > 0.0) {
            fmt::format_to(std::back_inserter(text), " {} {:.0f} %,", time::name(kind), share);
        }
    }
    text.pop_back();
    return text;
}

bool is_shown(const MonitorSnapshot& snapshot, std::size_t part) {
    const bool stage = part >= latency::kFirstStagePart && part < latency::kUnaccountedPart;
    const MonitorPart& one = snapshot.parts[part];
    return !stage || one.known > 0 || one.limit_ns.has_value() ||
           !latency::shown_only_if_known(part - latency::kFirstStagePart);
}

/// What of a part can be judged: nothing without a limit, or where too few frames know it.
enum class Standing { Unlimited, Unknown, Within, Above, Broken };

Standing standing_of(const MonitorPart& part) {
    if (!part.limit_ns) {
        return Standing::Unlimited;
    }
    if (part.broken) {
        return Standing::Broken;
    }
    if (!part.p95_ns) {
        return Standing::Unknown;
    }
    return *part.p95_ns > *part.limit_ns ? Standing::Above : Standing::Within;
}

std::string_view colour_of(Standing standing) {
    switch (standing) {
        case Standing::Broken:
        case Standing::Above:
            return kRed;
        case Standing::Within:
            return kGreen;
        case Standing::Unknown:
            return kYellow;
        case Standing::Unlimited:
            break;
    }
    return "";
}

class Panel {
  public:
    Panel(const MonitorSnapshot& snapshot, const PanelOptions& options)
        : snapshot_(snapshot),
          options_(options),
          columns_(static_cast<std::size_t>(std::max(options.columns, 2)) - 1) {
        for (const MonitorPart& part : snapshot.parts) {
            for (const auto& ns : {part.p99_ns, part.p95_ns, part.p50_ns, part.limit_ns}) {
                longest_ns_ = std::max(longest_ns_, ns.value_or(0));
            }
        }
    }

    std::vector<PanelLine> lines() {
        add(fmt::format("budget {}, last {:.1f} s{}, {} frames",
                        options_.budget.empty() ? "none" : options_.budget,
                        static_cast<double>(snapshot_.window_ns) * 1e-9,
                        snapshot_.window_cut ? " (no room for more)" : "", snapshot_.window_frames),
            kBold);
        add(shares(snapshot_), "");
        add(fmt::format("gaze {}: {}", name(snapshot_.state), states(snapshot_)), "");
        add_row("milliseconds", "p50", "p95", "p99", "allowed", "above", "longest run", "", kBold);
        for (std::size_t part = 0; part < latency::kMonitorPartCount; ++part) {
            if (is_shown(snapshot_, part)) {
                add_part(part);
            }
        }
        add(last_line(), "");
        const auto most = static_cast<std::size_t>(std::max(options_.rows, 2)) - 1;
        lines_.resize(std::min(lines_.size(), most));
        return std::move(lines_);
    }

  private:
    static std::string_view name(gaze::FoveaState state) {
        return gaze::kFoveaStateNames[static_cast<std::size_t>(state)];
    }

    [[nodiscard]] bool wide() const { return columns_ >= 75; }

    void add_part(std::size_t index) {
        const MonitorPart& part = snapshot_.parts[index];
        const std::string label = fmt::format("{}{}", index == latency::kAgePart ? "" : " ",
                                              latency::kMonitorPartNames[index]);
        add_row(label, figure(part.p50_ns), figure(part.p95_ns), figure(part.p99_ns),
                part.limit_ns ? figure(part.limit_ns) : "",
                part.limit_ns ? count(part.violations) : "", longest_run(part), bar(part),
                colour_of(standing_of(part)));
    }

    /// What a row has room for; the bar gets what is left.
    void add_row(std::string_view label, std::string_view p50, std::string_view p95,
                 std::string_view p99, std::string_view allowed, std::string_view above,
                 std::string_view run, std::string_view drawn, std::string_view colour) {
        std::string text;
        auto out = std::back_inserter(text);
        const bool budget = !options_.budget.empty();
        if (wide()) {
            fmt::format_to(out, "{:<19}{:>7}{:>7}{:>7}", label, p50, p95, p99);
            if (budget) {
                fmt::format_to(out, "{:>8}{:>6} {:>14}", allowed, above, run);
            }
        } else {
            fmt::format_to(out, "{:<19}{:>8}", label, p95);
            if (budget) {
                fmt::format_to(out, "{:>8}", allowed);
            }
        }
        text += ' ';
        text += drawn;
        add(text, colour);
    }

    [[nodiscard]] std::size_t bar_columns() const {
        const bool budget = !options_.budget.empty();
        const std::size_t used = wide() ? (budget ? 70 : 41) : (budget ? 36 : 28);
        constexpr std::size_t kMost = 60;
        return columns_ > used ? std::min(columns_ - used, kMost) : 0;
    }

    [[nodiscard]] std::string bar(const MonitorPart& part) const {
        const std::size_t width = bar_columns();
        constexpr std::size_t kFewest = 5;
        if (width < kFewest || longest_ns_ <= 0) {
            return {};
        }
        const auto at = [&](const std::optional<std::int64_t>& ns) {
            const double share = std::clamp(
                static_cast<double>(ns.value_or(0)) / static_cast<double>(longest_ns_), 0.0, 1.0);
            return static_cast<std::size_t>(std::lround(share * static_cast<double>(width - 1)));
        };
        std::string text(width, ' ');
        const std::size_t p50 = at(part.p50_ns);
        const std::size_t p95 = std::max(p50, at(part.p95_ns));
        const std::size_t p99 = std::max(p95, at(part.p99_ns));
        const auto from = [&](std::size_t column) {
            return text.begin() + static_cast<std::ptrdiff_t>(column);
        };
        std::fill(from(0), from(p50), '#');
        std::fill(from(p50), from(p95), '=');
        std::fill(from(p95), from(p99), '-');
        if (part.limit_ns) {
            text[at(part.limit_ns)] = '|';
        }
        text.erase(text.find_last_not_of(' ') + 1);
        return text;
    }

    [[nodiscard]] std::string last_line() const {
        const MonitorPart& age = snapshot_.parts[latency::kAgePart];
        return fmt::format("frame {}, missed {}, with gaze {}, of unknown age {}", snapshot_.frame,
                           snapshot_.missed, snapshot_.with_gaze, age.all_unknown);
    }

    void add(std::string_view text, std::string_view colour) {
        std::string cut(text.substr(0, columns_));
        // The name of a file may hold what moves a terminal's cursor.
        std::ranges::replace_if(cut, [](char c) { return c < ' ' || c > '~'; }, '?');
        lines_.push_back(
            {options_.colour && !colour.empty() ? fmt::format("{}{}{}", colour, cut, kPlain) : cut,
             static_cast<int>(cut.size())});
    }

    const MonitorSnapshot& snapshot_;
    const PanelOptions& options_;
    std::size_t
        columns_;  ///< the last one is left free: some terminals go on to the next line there
    std::int64_t longest_ns_ = 0;
    std::vector<PanelLine> lines_;
};

}  // namespace

std::vector<PanelLine> monitor_panel(const MonitorSnapshot& snapshot, const PanelOptions& options) {
    return Panel(snapshot, options).lines();
}

std::string monitor_line(const MonitorSnapshot& snapshot, std::string_view budget) {
    const MonitorPart& age = snapshot.parts[latency::kAgePart];
    std::string text = fmt::format(
        "monitor: gaze age at display p50 {}, p95 {}, p99 {} ms in {} of {} frames of "
        "{:.1f} s; gaze {}",
        figure(age.p50_ns), figure(age.p95_ns), figure(age.p99_ns), age.known,
        snapshot.window_frames, static_cast<double>(snapshot.window_ns) * 1e-9, states(snapshot));
    if (budget.empty()) {
        return text;
    }
    fmt::format_to(std::back_inserter(text), "; budget {}:", budget);
    bool any = false;
    for (std::size_t i = 0; i < latency::kMonitorPartCount; ++i) {
        const MonitorPart& part = snapshot.parts[i];
        if (part.broken) {
            fmt::format_to(std::back_inserter(text), "{} {} {} above {} ms",
                           any ? "," : " BROKEN:", latency::kMonitorPartNames[i],
                           figure(part.p95_ns), figure(part.limit_ns));
            any = true;
        }
    }
    if (!any) {
        const bool judged = std::ranges::any_of(
            snapshot.parts, [](const MonitorPart& part) { return part.limit_ns && part.p95_ns; });
        text += judged ? " kept" : " not judged yet";
    }
    any = false;
    for (std::size_t i = 0; i < latency::kMonitorPartCount; ++i) {
        if (snapshot.parts[i].violations > 0) {
            fmt::format_to(std::back_inserter(text), "{} {} {}",
                           any ? "," : "; frames above:", latency::kMonitorPartNames[i],
                           snapshot.parts[i].violations);
            any = true;
        }
    }
    fmt::format_to(std::back_inserter(text), "; of unknown age {}", age.all_unknown);
    return text;
}

}  // namespace gazeloop::report
