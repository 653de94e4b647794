#include "runtime/report/summary_text.h"

#include <fmt/format.h>

#include <iterator>
#include <optional>
#include <string_view>

#include "runtime/report/figures.h"
#include "runtime/report/happenings_text.h"
#include "runtime/report/summary_rows.h"
#include "runtime/time/milliseconds.h"

namespace gazeloop::report {
namespace {

std::string percent(std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? "-"
                      : fmt::format("{:.1f} %",
                                    100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

std::string share_line(const latency::SummaryReport& report) {
    if (!report.share_by_kind_percent) {
        return "eye-to-photon: unknown (no frame has both a gaze sample and a display time)\n";
    }
    const auto& share = *report.share_by_kind_percent;
    std::string line = "eye-to-photon:";
    for (const time::StampKind kind :
         {time::StampKind::Measured, time::StampKind::Profile, time::StampKind::Modelled,
          time::StampKind::Predicted, time::StampKind::Unknown}) {
        fmt::format_to(std::back_inserter(line), "{} {:.1f} % {}",
                       kind == time::StampKind::Measured ? "" : ",",
                       share[static_cast<std::size_t>(kind)], time::name(kind));
    }
    const std::uint64_t with_gaze = report.frames.with_gaze();
    const std::uint64_t known = report.gaze_age_at_display.count;
    if (known < with_gaze) {
        fmt::format_to(std::back_inserter(line),
                       ", in the {} of {} frames with gaze whose age is known", known, with_gaze);
    }
    return line + "\n";
}

/// "0.3 %", or "0.3 % of the 5.4 % known" where not all frames know it.
std::string missed_share(const latency::SummaryReport& report) {
    const std::optional<double> missed = report.missed_percent();
    if (!missed) {
        return "unknown";
    }
    const latency::FrameCounts& frames = report.frames;
    const double known_percent = 100.0 - 100.0 * static_cast<double>(frames.in_time_unknown) /
                                             static_cast<double>(frames.rendered);
    return frames.in_time_unknown == 0
               ? fmt::format("{:.1f} %", *missed)
               : fmt::format("{:.1f} % of the {:.1f} % known", *missed, known_percent);
}

/// "median interval 11.11 ms, display period 11.11 ms, missed 0.3 %".
std::string pace(const latency::SummaryReport& report) {
    const std::optional<double> period_ms =
        report.config.period_ns > 0
            ? std::optional(static_cast<double>(report.config.period_ns) / time::kNsPerMs)
            : std::nullopt;
    const auto with_unit = [](const std::optional<double>& ms) {
        return ms ? figure(ms) + " ms" : "unknown";
    };
    return fmt::format("median interval {}, display period {}, missed {}",
                       with_unit(report.frame_interval.p50_ms), with_unit(period_ms),
                       missed_share(report));
}

std::string verdict_line(const latency::SummaryReport& report) {
    switch (report.verdict) {
        case latency::Verdict::RealTime:
            return "real time: " + pace(report) + "\n";
        case latency::Verdict::NotRealTime:
            return "NOT REAL TIME: " + pace(report) + "; no latency verdict\n";
        case latency::Verdict::VirtualTime:
            return "virtual time: durations of the loop are modelled\n";
        case latency::Verdict::Unknown:
            break;
    }
    return "no latency verdict: " + pace(report) + "\n";
}

void append_table(std::string& text, const latency::SummaryReport& report) {
    auto out = std::back_inserter(text);
    constexpr std::string_view kRow = "{:<24}{:<11}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}\n";
    fmt::format_to(out, kRow, "milliseconds", "kind", "frames", "min", "mean", "p50", "p95", "p99",
                   "max");
    bool withheld = false;
    bool mixed = false;
    for (const NamedRow& named : rows_of(report)) {
        const latency::DurationRow& row = *named.row;
        fmt::format_to(out, kRow, named.name.label, kind_text(row.frames_by_kind),
                       count_text(row.count), figure(row.min_ms), figure(row.mean_ms),
                       figure(row.p50_ms), figure(row.p95_ms), figure(row.p99_ms),
                       figure(row.max_ms));
        withheld = withheld || !row.p99_ms;
        mixed = mixed || row.mixed();
    }
    if (withheld) {
        text += "-: unknown, or withheld because a percentile p needs 1 / (1 - p) frames\n";
    }
    if (mixed) {
        text += "+: the least certain kind of several\n";
    }
}

/// "2 (0.1 %) by 3 periods, unknown of 4 frames".
std::string missed(const latency::SummaryReport& report) {
    const latency::FrameCounts& frames = report.frames;
    const std::optional<double> percent_missed = report.missed_percent();
    if (!percent_missed) {
        return "unknown";
    }
    std::string text = fmt::format("{} ({:.1f} %) by {} periods", count_text(frames.missed),
                                   *percent_missed, count_text(frames.periods_missed));
    if (frames.in_time_unknown > 0) {
        text += fmt::format(", unknown of {} frames", count_text(frames.in_time_unknown));
    }
    return text;
}

/// Said only where there is a mask.
std::string hidden(const frame::SampleCounts& samples, std::uint64_t of_them) {
    return samples.pixels_hidden > 0 ? fmt::format(", hidden {}", count_text(of_them)) : "";
}

void append_counts(std::string& text, const latency::SummaryReport& report) {
    auto out = std::back_inserter(text);
    const latency::FrameCounts& frames = report.frames;
    fmt::format_to(out, "frames   {}, rendered {}\nmissed   {}", count_text(frames.total),
                   count_text(frames.rendered), missed(report));
    if (frames.display_unknown > 0) {
        fmt::format_to(out, "\nshown    at an unknown time in {} of {} rendered frames",
                       count_text(frames.display_unknown), count_text(frames.rendered));
    }
    text += "\ngaze    ";
    for (std::size_t state = 0; state < frames.by_state.size(); ++state) {
        fmt::format_to(out, "{} {} {}", state == 0 ? "" : ",", gaze::kFoveaStateNames[state],
                       percent(frames.by_state[state], frames.rendered));
    }
    fmt::format_to(out, "\nsamples  received {}, invalid {}, lost {}, out of order {}\n",
                   count_text(report.gaze.received), count_text(report.gaze.invalid),
                   count_text(report.gaze.lost), count_text(report.gaze.out_of_order));
    const frame::SampleCounts& samples = report.samples;
    for (std::size_t grid = 0; grid < report.config.grids.size(); ++grid) {
        const frame::GridCounts& counts = samples.grids[grid];
        fmt::format_to(out, "{:<8} shaded {} of {}", report.config.grids[grid],
                       count_text(counts.shaded), count_text(counts.planned));
        if (counts.off_screen > 0) {
            fmt::format_to(out, ", off screen {}", count_text(counts.off_screen));
        }
        if (counts.covered > 0) {
            fmt::format_to(out, ", covered by another grid {}", count_text(counts.covered));
        }
        text += hidden(samples, counts.hidden) + "\n";
    }
    fmt::format_to(out, "pixels   {}{}\n", count_text(samples.pixels_output),
                   hidden(samples, samples.pixels_hidden));
    if (const std::optional<double> fewer = report.samples_saved_factor()) {
        const std::string compared =
            *fewer > 1.0   ? fmt::format("{:.1f}x fewer samples than", *fewer)
            : *fewer < 1.0 ? fmt::format("{:.1f}x more samples than", 1.0 / *fewer)
                           : "as many samples as";
        text += "shading  " + compared + " full resolution\n";
    }
}

}  // namespace

std::string summary_head(const latency::SummaryReport& report) {
    return report.verdict == latency::Verdict::NotRealTime
               ? verdict_line(report) + share_line(report)
               : share_line(report) + verdict_line(report);
}

std::string summary_notes(const latency::SummaryReport& report) {
    std::string text;
    if (!report.config.switching_ns) {
        text += "The display's switching time is unknown and in none of these ages.\n";
    }
    if (!report.config.rolling_ns) {
        text +=
            "Which rows the display lights when is unknown: ages are those of its middle row.\n";
    }
    if (report.config.persistence_ns) {
        fmt::format_to(std::back_inserter(text),
                       "A pixel is lit for {:.2f} ms, half of it before these ages (profile).\n",
                       static_cast<double>(*report.config.persistence_ns) / 1e6);
    }
    if (!report.config.assumed.empty()) {
        fmt::format_to(std::back_inserter(text),
                       "Assumed, not published, in the display's profile: {}.\n",
                       report.config.assumed);
    }
    return text;
}

std::string summary_counts(const latency::SummaryReport& report) {
    std::string text;
    append_counts(text, report);
    if (const std::string happened = happenings_text(report); !happened.empty()) {
        text += "\n" + happened;
    }
    return text;
}

std::string summary_text(const latency::SummaryReport& report, std::string_view lag) {
    std::string text = summary_head(report);
    if (!lag.empty()) {
        text += fmt::format("\n{}", lag);
    }
    text += "\n";
    append_table(text, report);
    return text + summary_notes(report) + "\n" + summary_counts(report);
}

}  // namespace gazeloop::report
