#include "runtime/report/prediction_text.h"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "runtime/report/lag_facts.h"
#include "runtime/report/wrapped_row.h"
#include "runtime/time/milliseconds.h"

namespace gazeloop::report {
namespace {

using latency::Part;

double to_ms(std::int64_t ns) { return static_cast<double>(ns) / time::kNsPerMs; }

std::optional<double> to_ms(const std::optional<std::int64_t>& ns) {
    return ns ? std::optional(to_ms(*ns)) : std::nullopt;
}

std::string_view words(Part part) {
    constexpr std::array<std::string_view, latency::kPartCount> kWords{
        "tracker",         "delivery", "sample waits",     "eye waits for a frame",
        "loop and driver", "gpu",      "wait for display", "scan to row",
        "switching"};
    return kWords[static_cast<std::size_t>(part)];
}

std::string cell(const std::optional<double>& ms) {
    if (!ms) {
        return "-";
    }
    constexpr std::size_t kColumn = 8;
    std::string text = fmt::format("{:.2f}", *ms);
    return text.size() <= kColumn ? text : fmt::format("{:.1e}", *ms);
}

/// ">=12.00": unknown parts come on top.
std::string sum_cell(std::int64_t ns, bool at_least) {
    return (at_least ? ">=" : "") + cell(to_ms(ns));
}

std::string range_text(const latency::PredictedSum& sum) {
    if (sum.best_at_least || sum.worst_at_least) {
        return fmt::format("{}{} to {}{} ms", sum.best_at_least ? "at least " : "",
                           cell(to_ms(sum.best_ns)), sum.worst_at_least ? "at least " : "",
                           cell(to_ms(sum.worst_ns)));
    }
    return fmt::format("{:.1f} to {:.1f} ms", to_ms(sum.best_ns), to_ms(sum.worst_ns));
}

/// "p99 (44.2 ms) lies above it, most because of wait for display (18.0 ms, at most 11.1)".
std::string outside_text(const latency::OutsidePrediction& outside) {
    std::string text = fmt::format("{} ({:.1f} ms) lies {} that", outside.what, outside.measured_ms,
                                   outside.above ? "above" : "below");
    if (outside.part) {
        const std::string_view bound = outside.above ? "most" : "least";
        const std::string limit =
            outside.part_limit_ms == 0.0
                ? "taken for nothing"
                : fmt::format("predicted at {} {:.1f}", bound, outside.part_limit_ms);
        fmt::format_to(std::back_inserter(text), ", mostly by {} ({:.1f} ms, {})",
                       words(*outside.part), outside.part_measured_ms, limit);
    }
    return text;
}

std::string unknown_text(const latency::PredictionCheck& check) {
    std::string text;
    for (const Part part : check.unknown) {
        text += (text.empty() ? "" : ", ") + std::string(words(part));
    }
    return text;
}

}  // namespace

std::string prediction_sentence(const latency::PredictionCheck& check) {
    const bool any = std::ranges::any_of(
        check.predicted.parts, [](const auto& part) { return part.least_ns || part.greatest_ns; });
    if (!any) {
        return {};
    }
    const latency::PredictedSum sum = check.predicted.gaze_age();
    std::string text = "; its parts allow " + range_text(sum);
    if (!check.outside.empty()) {
        // The middle of the distribution says more than its ends.
        const auto by_weight = [](const latency::OutsidePrediction& one) {
            return one.what == "p50" ? 0 : one.what == "p95" ? 1 : one.what == "p99" ? 2 : 3;
        };
        const auto& first = *std::ranges::min_element(check.outside, {}, by_weight);
        return text + ", and its " + outside_text(first);
    }
    if (!check.comparable) {
        return check.unknown.empty() ? text
                                     : text + ", of which is unknown: " + unknown_text(check);
    }
    return text + ", which it keeps";
}

PredictionTable prediction_table(const latency::PredictionCheck& check,
                                 const latency::SummaryReport& report) {
    PredictionTable table;
    const auto add = [&](std::string_view label, const std::string& best, const std::string& worst,
                         const latency::DurationRow* row) {
        const latency::DurationRow none;
        const latency::DurationRow& measured = row != nullptr ? *row : none;
        table.rows.push_back(
            {std::string(label),
             {best, worst, cell(measured.min_ms), cell(measured.p50_ms), cell(measured.p95_ms),
              cell(measured.p99_ms), cell(measured.max_ms)}});
    };
    const auto add_sum = [&](std::string_view label, const latency::PredictedSum& sum,
                             const latency::DurationRow* row) {
        add(label, sum_cell(sum.best_ns, sum.best_at_least),
            sum_cell(sum.worst_ns, sum.worst_at_least), row);
    };
    add_sum("gaze age at display", check.predicted.gaze_age(), &report.gaze_age_at_display);
    for (std::size_t p = 0; p < latency::kPartCount; ++p) {
        const Part part{static_cast<std::uint8_t>(p)};
        const latency::PartRange& range = check.predicted.parts[p];
        if (part != Part::Phase) {
            add("  " + std::string(words(part)), cell(to_ms(range.least_ns)),
                cell(to_ms(range.greatest_ns)), latency::measured_row(report, part));
        }
    }
    const latency::PartRange& phase = check.predicted.parts[static_cast<std::size_t>(Part::Phase)];
    add(words(Part::Phase), cell(to_ms(phase.least_ns)), cell(to_ms(phase.greatest_ns)), nullptr);
    add_sum("eye to photon", check.predicted.eye_to_photon(), nullptr);
    for (const latency::OutsidePrediction& outside : check.outside) {
        table.notes.push_back("Outside: " + outside_text(outside) + ".");
    }
    if (check.tracker_uncertainty_ns.value_or(0) > 0) {
        table.notes.push_back(
            fmt::format("The tracker's delay is uncertain by {:.1f} ms, either "
                        "way: that moves all of these ages alike.",
                        to_ms(*check.tracker_uncertainty_ns)));
    }
    if (!check.unknown.empty()) {
        table.notes.push_back(
            "Unknown, so that the worst case is at least that: " + unknown_text(check) + ".");
    }
    return table;
}

std::string prediction_text(const latency::PredictionCheck& check,
                            const latency::SummaryReport& report) {
    const PredictionTable table = prediction_table(check, report);
    std::string text;
    const auto append = [&](std::string_view label, const auto& cells) {
        fmt::format_to(std::back_inserter(text), "{:<24}{:>11}{:>11}{:>9}{:>9}{:>9}{:>9}{:>9}\n",
                       label, cells[0], cells[1], cells[2], cells[3], cells[4], cells[5], cells[6]);
    };
    append("predicted, milliseconds", PredictionTable::kHeads);
    for (const PredictionTable::Row& row : table.rows) {
        append(row.label, row.cells);
    }
    for (const std::string& note : table.notes) {
        text += wrapped_row("", note, 0);
    }
    return text;
}

nlohmann::ordered_json prediction_json(const latency::PredictionCheck& check) {
    using Json = nlohmann::ordered_json;
    const auto or_null = [](const std::optional<double>& ms) { return ms ? Json(*ms) : Json(); };
    const auto sum_json = [](const latency::PredictedSum& sum) {
        return Json{{"best_ms", to_ms(sum.best_ns)},
                    {"best_is_at_least", sum.best_at_least},
                    {"worst_ms", to_ms(sum.worst_ns)},
                    {"worst_is_at_least", sum.worst_at_least}};
    };
    Json parts = Json::object();
    for (std::size_t part = 0; part < latency::kPartCount; ++part) {
        const latency::PartRange& range = check.predicted.parts[part];
        parts[std::string(latency::kPartNames[part])] = {
            {"least_ms", or_null(to_ms(range.least_ns))},
            {"greatest_ms", or_null(to_ms(range.greatest_ns))}};
    }
    Json unknown = Json::array();
    for (const Part part : check.unknown) {
        unknown.push_back(latency::kPartNames[static_cast<std::size_t>(part)]);
    }
    Json outside = Json::array();
    for (const latency::OutsidePrediction& one : check.outside) {
        Json entry{{"figure", one.what},
                   {"measured_ms", one.measured_ms},
                   {one.above ? "worst_ms" : "best_ms", one.limit_ms},
                   {"part", nullptr}};
        if (one.part) {
            entry["part"] = latency::kPartNames[static_cast<std::size_t>(*one.part)];
            entry["part_measured_ms"] = one.part_measured_ms;
            entry["part_limit_ms"] = one.part_limit_ms;
        }
        outside.push_back(entry);
    }
    return {{"gaze_age_at_display", sum_json(check.predicted.gaze_age())},
            {"eye_to_photon", sum_json(check.predicted.eye_to_photon())},
            {"parts", parts},
            {"tracker_uncertainty_ms", or_null(to_ms(check.tracker_uncertainty_ns))},
            {"unknown_parts", unknown},
            {"comparable", check.comparable},
            {"outside", outside}};
}

}  // namespace gazeloop::report
