#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

#include "runtime/report/runtime_metrics/covered_time.h"
#include "runtime/report/runtime_metrics/runtime_metrics_join.h"

namespace gazeloop::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, kMonadoFateCount> kFateKeys{
    "presented", "modelled", "replaced", "missing", "discarded", "not_taken", "untimed"};

void append_unjoined(std::string& text, const MetricsJoinCounts& counts) {
    const auto line = [&text](std::uint64_t frames, std::string_view why) {
        if (frames > 0) {
            fmt::format_to(std::back_inserter(text), "  not joined: {} {}\n", frames, why);
        }
    };
    line(counts.of(MonadoFate::Missing), "with a display time that the file does not have");
    line(counts.of(MonadoFate::NotTaken),
         "that no frame of the compositor took, as far as it says");
    line(counts.of(MonadoFate::Untimed),
         "that were taken, but not said to be shown at a time that can be");
    line(counts.of(MonadoFate::Discarded), "that the program discarded, as the runtime saw it");
    line(counts.not_announced, "whose display time no runtime announced");
    if (counts.of(MonadoFate::Replaced) > 0) {
        fmt::format_to(
            std::back_inserter(text),
            "  never shown: {}; the compositor took a later one. They have no age at display.\n",
            counts.of(MonadoFate::Replaced));
    }
    if (counts.repeated > 0) {
        fmt::format_to(std::back_inserter(text),
                       "  shown more than once: {}; no later one was there in time\n",
                       counts.repeated);
    }
}

void append_kind(std::string& text, const MetricsJoinCounts& counts) {
    auto out = std::back_inserter(text);
    if (counts.of(MonadoFate::Presented) > 0) {
        fmt::format_to(
            out,
            "  In {} the display's driver said when the scan-out began (measured). Their display\n"
            "  is that and Monado's constant from there to the light (profile).\n",
            counts.of(MonadoFate::Presented));
    }
    if (counts.of(MonadoFate::Modelled) > 0) {
        fmt::format_to(
            out,
            "  In {} which frame of the compositor took them is measured. When that was shown is\n"
            "  Monado's model of a display (modelled): it has no display timing here.\n",
            counts.of(MonadoFate::Modelled));
    }
    if (counts.compositor_late > 0) {
        fmt::format_to(out,
                       "  In {} of these the compositor's own work ended after that: shown later, "
                       "not known when.\n",
                       counts.compositor_late);
    }
}

void append_file(std::string& text, const MonadoFileCounts& counts) {
    auto out = std::back_inserter(text);
    if (counts.damaged > 0) {
        fmt::format_to(out, "  The file: {} damaged records left out, the first at byte {}\n",
                       counts.damaged, counts.first_damaged_at);
    }
    if (counts.unknown > 0) {
        fmt::format_to(out, "  The file: {} records of a kind that is not known here\n",
                       counts.unknown);
    }
    if (counts.cut_at) {
        fmt::format_to(out, "  The file: its last record, at byte {}, was cut short\n",
                       *counts.cut_at);
    }
    if (counts.lost_at) {
        fmt::format_to(out, "  The file: damaged at byte {}, and not read from there on\n",
                       *counts.lost_at);
    }
}

}  // namespace

std::string RuntimeMetricsJoin::text() const {
    std::string text =
        fmt::format("runtime  {} of {} rendered frames joined with Monado's metrics\n  {}\n",
                    counts_.joined(), counts_.frames, frames_.file().name());
    append_kind(text, counts_);
    append_unjoined(text, counts_);
    if (counts_.joined() == 0 && counts_.frames > counts_.not_announced) {
        fmt::format_to(
            std::back_inserter(text),
            "  The file has {}, the session {}. It is of this run only where a\n"
            "  monado-service with XRT_METRICS_FILE served it; no other Monado writes metrics.\n",
            covered_time(frames_.first_ns(), frames_.last_ns()),
            covered_time(counts_.first_ns, counts_.last_ns));
    }
    append_file(text, frames_.file().counts());
    return text;
}

Json RuntimeMetricsJoin::json() const {
    const MonadoFileCounts& file = frames_.file().counts();
    const auto or_null = [](const std::optional<std::uint64_t>& value) {
        return value ? Json(*value) : Json(nullptr);
    };
    Json frames{{"rendered", counts_.frames}, {"joined", counts_.joined()}};
    for (std::size_t fate = 0; fate < kMonadoFateCount; ++fate) {
        frames[std::string(kFateKeys[fate])] = counts_.by_fate[fate];
    }
    frames["not_announced"] = counts_.not_announced;
    frames["repeated"] = counts_.repeated;
    frames["compositor_late"] = counts_.compositor_late;
    return {
        {"file", frames_.file().name()},
        {"version",
         fmt::format("{}.{}", frames_.file().version().major, frames_.file().version().minor)},
        {"frames", frames},
        {"records",
         {{"read", file.records},
          {"unknown", file.unknown},
          {"damaged", file.damaged},
          {"first_damaged_at_byte", file.damaged > 0 ? Json(file.first_damaged_at) : Json(nullptr)},
          {"cut_at_byte", or_null(file.cut_at)},
          {"lost_at_byte", or_null(file.lost_at)}}}};
}

}  // namespace gazeloop::report
