#include "runtime/report/runtime_metrics/wivrn_frames.h"

#include <algorithm>
#include <utility>

namespace gazeloop::report {
namespace {

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::min();

bool ends(WivrnEvent event) {
    return event == WivrnEvent::EncodeEnd || event == WivrnEvent::SendEnd ||
           event == WivrnEvent::ReceiveEnd || event == WivrnEvent::DecodeEnd;
}

/// A frame is seen whole when its last stream is.
bool ends_for_all(WivrnEvent event) {
    return ends(event) || event == WivrnEvent::Blit || event == WivrnEvent::Display;
}

}  // namespace

void WivrnTimes::add(WivrnEvent event, std::int64_t ns) {
    std::int64_t& kept = ns_[static_cast<std::size_t>(event)];
    kept = kept == kNone ? ns : ends(event) ? std::max(kept, ns) : std::min(kept, ns);
}

WivrnTimes WivrnFrame::together() const {
    WivrnTimes all = of_frame;
    for (std::size_t i = 0; i < kWivrnEventCount; ++i) {
        const auto event = static_cast<WivrnEvent>(i);
        std::optional<std::int64_t> ns;
        for (const WivrnTimes& stream : streams) {
            if (const auto of_stream = stream[event]) {
                ns = !ns                   ? *of_stream
                     : ends_for_all(event) ? std::max(*ns, *of_stream)
                                           : std::min(*ns, *of_stream);
            }
        }
        if (ns) {
            all.add(event, *ns);
        }
    }
    return all;
}

WivrnTimes WivrnFrame::of_stream(std::size_t stream) const {
    WivrnTimes times = of_frame;
    for (std::size_t i = 0; i < kWivrnEventCount; ++i) {
        const auto event = static_cast<WivrnEvent>(i);
        if (const auto ns = streams[stream][event]) {
            times.add(event, *ns);
        }
    }
    return times;
}

WivrnFrames::WivrnFrames(WivrnCsvReader file)
    : file_(std::move(file)), frames_(kKept), display_ns_(kKept, kNever) {}

Expected<void> WivrnFrames::read_until(std::int64_t until_ns) {
    constexpr int kEnough = 64;  // rows in a row that lie behind it
    int behind = last_ns_ && *last_ns_ > until_ns ? kEnough : 0;
    while (!at_end_ && behind < kEnough) {
        const auto row = file_.next();
        if (!row) {
            at_end_ = true;
            return std::unexpected(row.error());
        }
        if (!*row) {
            at_end_ = true;
            break;
        }
        take(**row);
        first_ns_ = first_ns_.value_or((*row)->ns);
        last_ns_ = (*row)->ns;
        behind = (*row)->ns > until_ns ? behind + 1 : 0;
    }
    return {};
}

void WivrnFrames::take(const WivrnRow& row) {
    const std::size_t place = static_cast<std::size_t>(row.frame % kKept);
    WivrnFrame& frame = frames_[place];
    if (frame.number != row.frame) {
        frame = {.number = row.frame};
        display_ns_[place] = kNever;
    }
    if (!row.stream) {
        frame.of_frame.add(row.event, row.ns);
    } else if (*row.stream < WivrnFrame::kMostStreams) {
        frame.streams[*row.stream].add(row.event, row.ns);
    } else {
        ++other_streams_;
        return;
    }
    if (row.event == WivrnEvent::Display) {
        display_ns_[place] = frame.together()[WivrnEvent::Display].value_or(kNever);
    }
}

WivrnFrame* WivrnFrames::nearest(std::int64_t display_ns, std::int64_t tolerance_ns) {
    std::uint64_t best = std::numeric_limits<std::uint64_t>::max();
    std::size_t place = 0;
    for (std::size_t i = 0; i < kKept; ++i) {
        const auto of_frame = static_cast<std::uint64_t>(display_ns_[i]);
        const auto wanted = static_cast<std::uint64_t>(display_ns);
        const std::uint64_t apart =
            display_ns_[i] < display_ns ? wanted - of_frame : of_frame - wanted;
        if (apart < best) {
            best = apart;
            place = i;
        }
    }
    const bool near = tolerance_ns >= 0 && best <= static_cast<std::uint64_t>(tolerance_ns);
    return near && display_ns_[place] != kNever ? &frames_[place] : nullptr;
}

}  // namespace gazeloop::report
