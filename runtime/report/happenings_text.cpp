#include "runtime/report/happenings_text.h"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "runtime/time/span.h"

namespace gazeloop::report {
namespace {

constexpr std::size_t kColumns = 100;
constexpr std::string_view kIndent = "    ";

std::optional<double> seconds(const time::Stamp& began, const time::Stamp& at) {
    const time::Span since = time::between(began, at);
    return since.known() ? std::optional(static_cast<double>(since.ns) * 1e-9) : std::nullopt;
}

std::string when(const latency::Happening& happening, const time::Stamp& began) {
    if (happening.kind.view() == frame::kLeftOutEvent.name ||
        happening.kind.view() == frame::kViewsEvent.name) {
        return " all along";
    }
    const auto first = seconds(began, happening.first);
    const auto last = seconds(began, happening.last);
    const std::string times =
        happening.times > 1 ? fmt::format(", {} times", happening.times) : std::string();
    if (!first || !last) {
        return times + ", at an unknown time";
    }
    return happening.times > 1 ? fmt::format("{} from {:.3f} s to {:.3f} s", times, *first, *last)
                               : fmt::format(" at {:.3f} s", *first);
}

/// Broken at blanks; a word that is longer than a line is cut.
void append_wrapped(std::string& text, std::string_view words) {
    std::size_t room = kColumns;
    while (!words.empty()) {
        std::size_t end = words.size();
        if (end > room) {
            const std::size_t blank = words.rfind(' ', room);
            end = blank == std::string_view::npos || blank == 0 ? room : blank;
        }
        text += words.substr(0, end);
        text += '\n';
        words.remove_prefix(end);
        words.remove_prefix(std::min(words.find_first_not_of(' '), words.size()));
        if (!words.empty()) {
            text += kIndent;
        }
        room = kColumns - kIndent.size();
    }
}

}  // namespace

std::string happenings_text(const latency::SummaryReport& report) {
    std::string text;
    if (report.happenings.empty() && report.other_happenings == 0) {
        return text;
    }
    text += "what happened, from the first frame on\n";
    for (const latency::Happening& happening : report.happenings) {
        append_wrapped(text, fmt::format("- {}{}: {}", happening.kind.view(),
                                         when(happening, report.began), happening.text.view()));
    }
    if (report.other_happenings > 0) {
        append_wrapped(text, fmt::format("- and {} events of more kinds than are kept apart: the "
                                         "recording, if there is one, has them",
                                         report.other_happenings));
    }
    return text;
}

nlohmann::ordered_json happenings_json(const latency::SummaryReport& report) {
    using Json = nlohmann::ordered_json;
    const auto or_null = [](const std::optional<double>& s) {
        return s ? Json(*s) : Json(nullptr);
    };
    Json list = Json::array();
    for (const latency::Happening& happening : report.happenings) {
        list.push_back({{"kind", happening.kind.view()},
                        {"warning", happening.weight == frame::EventWeight::Warning},
                        {"times", happening.times},
                        {"first_s", or_null(seconds(report.began, happening.first))},
                        {"last_s", or_null(seconds(report.began, happening.last))},
                        {"text", happening.text.view()}});
    }
    return list;
}

}  // namespace gazeloop::report
