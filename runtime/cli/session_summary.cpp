#include "runtime/cli/session_summary.h"

#include <charconv>
#include <optional>

namespace gazeloop::cli {
namespace {

std::optional<std::int64_t> meta_ns(const session::SessionFile& session, std::string_view name) {
    const auto text = session.meta(name);
    std::int64_t value = 0;
    if (!text ||
        std::from_chars(text->data(), text->data() + text->size(), value).ec != std::errc{}) {
        return std::nullopt;
    }
    return value;
}

}  // namespace

latency::SummaryConfig summary_config(const session::SessionFile& session) {
    return {.clock = session.meta("clock") == "virtual" ? latency::LoopClock::Virtual
                                                        : latency::LoopClock::Wall,
            .period_ns = meta_ns(session, "display_period_ns").value_or(0),
            .switching_ns = meta_ns(session, "display_switching_ns")};
}

latency::SummaryReport summarize(const session::SessionFile& session) {
    latency::LatencySummary summary(summary_config(session));
    for (const session::RecordedSample& sample : session.samples) {
        summary.add(sample.sample);
    }
    for (const session::RecordedFrame& frame : session.frames) {
        if (frame.frame.period_ns > 0) {
            summary.set_display_period(frame.frame.period_ns);
        }
        summary.add(frame.frame);
        summary.add(frame.gpu);
    }
    return summary.report();
}

}  // namespace gazeloop::cli
