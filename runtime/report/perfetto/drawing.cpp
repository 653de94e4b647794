#include "runtime/report/perfetto/drawing.h"

#include <algorithm>

namespace gazeloop::report::perfetto {

Drawing::Drawing(TraceWriter& writer, Tracks& tracks, Unshown& unshown)
    : writer_(writer),
      tracks_(tracks),
      unshown_(unshown),
      kind_(writer.key("kind")),
      begin_kind_(writer.key("begin_kind")),
      end_kind_(writer.key("end_kind")),
      kinds_(writer) {
    constexpr std::size_t kEventsOfAFrame = 64;
    events_.reserve(kEventsOfAFrame);
}

bool Drawing::shows(Subject subject, const time::Stamp& at) {
    if (!at.known()) {
        unshown_.add(subject, WhyUnshown::Unknown);
    } else if (!drawable_time(at.ns)) {
        unshown_.add(subject, WhyUnshown::OutOfRange);
    } else {
        return true;
    }
    return false;
}

bool Drawing::shows(Subject subject, const Part& part) {
    const bool both_known = part.from.known() && part.to.known();
    if (both_known && part.to.ns < part.from.ns) {
        unshown_.add(subject, WhyUnshown::Backwards);
        return false;
    }
    return shows(subject, part.from.known() && drawable_time(part.from.ns) ? part.to : part.from);
}

TraceEvent& Drawing::add(EventType type, TrackId track, std::int64_t ns, NameId name) {
    TraceEvent& event = events_.emplace_back();
    event.type = type;
    event.track = track;
    event.ns = ns;
    event.name = name;
    return event;
}

Drawing::Place Drawing::begin(TrackId track, const Part& part) {
    TraceEvent& event = add(EventType::SliceBegin, track, part.from.ns, part.name);
    if (part.from.kind == part.to.kind) {
        event.annotations.add(kind_, kinds_.of(part.from.kind));
    } else {
        event.annotations.add(begin_kind_, kinds_.of(part.from.kind));
        event.annotations.add(end_kind_, kinds_.of(part.to.kind));
    }
    return events_.size() - 1;
}

std::optional<Drawing::Place> Drawing::slice(Subject subject, const Part& part) {
    return nested(subject, part, {}).whole;
}

Drawing::Nested Drawing::nested(Subject subject, const Part& whole, std::span<const Part> parts) {
    Nested drawn;
    std::optional<TrackId> track;
    if (shows(subject, whole)) {
        track = tracks_.take(subject, whole.from.ns, whole.to.ns);
        if (track) {
            drawn.whole = begin(*track, whole);
        } else {
            unshown_.add(subject, WhyUnshown::TooMany);
        }
    }
    parts = parts.first(std::min(parts.size(), kMostParts));
    std::array<bool, kMostParts> outside{};
    std::int64_t free_from_ns = whole.from.ns;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Part& part = parts[i];
        if (!shows(subject, part)) {
            continue;
        }
        if (!track || part.from.ns < free_from_ns || part.to.ns > whole.to.ns) {
            outside[i] = true;
            continue;
        }
        drawn.parts[i] = begin(*track, part);
        add(EventType::SliceEnd, *track, part.to.ns);
        free_from_ns = part.to.ns;
    }
    if (track) {
        add(EventType::SliceEnd, *track, whole.to.ns);
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (outside[i]) {
            drawn.parts[i] = slice(subject, parts[i]);
        }
    }
    return drawn;
}

std::optional<Drawing::Place> Drawing::instant(Subject subject, NameId name,
                                               const time::Stamp& at) {
    if (!shows(subject, at)) {
        return std::nullopt;
    }
    add(EventType::Instant, tracks_.of(subject), at.ns, name)
        .annotations.add(kind_, kinds_.of(at.kind));
    return events_.size() - 1;
}

std::optional<Drawing::Place> Drawing::instant(Subject subject, std::string_view name,
                                               const time::Stamp& at) {
    const auto place = instant(subject, NameId{}, at);
    if (place) {
        events_[*place].text = name;
    }
    return place;
}

void Drawing::counter(Subject subject, const time::Stamp& at, double value) {
    if (shows(subject, at)) {
        add(EventType::Counter, tracks_.of(subject), at.ns).value = value;
    }
}

void Drawing::annotate(std::optional<Place> place, KeyId key, decltype(Annotation::value) value) {
    if (place) {
        events_[*place].annotations.add(key, value);
    }
}

void Drawing::connect(std::uint64_t flow, std::span<const std::optional<Place>> hops) {
    if (hops.empty() || !hops.back()) {
        return;
    }
    TraceEvent& last = events_[*hops.back()];
    std::optional<std::int64_t> before_ns;
    for (const std::optional<Place>& hop : hops.first(hops.size() - 1)) {
        if (!hop) {
            continue;
        }
        TraceEvent& event = events_[*hop];
        if (event.ns <= last.ns && event.ns >= before_ns.value_or(event.ns)) {
            event.flow = Flow{.id = flow};
            before_ns = event.ns;
        }
    }
    if (before_ns) {
        last.flow = Flow{.id = flow, .ends = true};
    }
}

void Drawing::write() {
    for (const TraceEvent& event : events_) {
        writer_.add(event);
    }
    events_.clear();
}

}  // namespace gazeloop::report::perfetto
