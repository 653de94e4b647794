#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "runtime/report/perfetto/kind_texts.h"
#include "runtime/report/perfetto/tracks.h"
#include "runtime/report/perfetto/unshown.h"
#include "runtime/time/stamp.h"

namespace gazeloop::report::perfetto {

/// A slice to be. How its ends were obtained is annotated: "kind", or "begin_kind" and "end_kind"
/// where they differ.
struct Part {
    NameId name{};
    time::Stamp from;
    time::Stamp to;
};

/// Events that are put together, joined by arrows, and then written, so that arrows join only what
/// is drawn. What cannot be drawn is counted. Without allocation once it has been full.
class Drawing {
  public:
    using Place = std::size_t;  ///< of an event, until write()
    static constexpr std::size_t kMostParts = 16;

    /// Where the begins of slices that nest are.
    struct Nested {
        std::optional<Place> whole;
        std::array<std::optional<Place>, kMostParts> parts;
    };

    Drawing(TraceWriter& writer, Tracks& tracks, Unshown& unshown);

    std::optional<Place> slice(Subject subject, const Part& part);
    /// Parts that do not lie within the whole, one after the other, are drawn outside it. Of more
    /// than kMostParts the rest are left out.
    Nested nested(Subject subject, const Part& whole, std::span<const Part> parts);
    std::optional<Place> instant(Subject subject, NameId name, const time::Stamp& at);
    /// Of a name that is not one of a few, and stays where it is until write().
    std::optional<Place> instant(Subject subject, std::string_view name, const time::Stamp& at);
    void counter(Subject subject, const time::Stamp& at, double value);

    void annotate(std::optional<Place> place, KeyId key, decltype(Annotation::value) value);

    /// Arrows from each of these to the next one, those left out that are earlier than the one
    /// before. None unless the last one is drawn and another one.
    void connect(std::uint64_t flow, std::span<const std::optional<Place>> hops);

    void write();

  private:
    bool shows(Subject subject, const time::Stamp& at);
    bool shows(Subject subject, const Part& part);
    TraceEvent& add(EventType type, TrackId track, std::int64_t ns, NameId name = {});
    Place begin(TrackId track, const Part& part);

    TraceWriter& writer_;
    Tracks& tracks_;
    Unshown& unshown_;
    KeyId kind_;
    KeyId begin_kind_;
    KeyId end_kind_;
    KindTexts kinds_;
    std::vector<TraceEvent> events_;
};

}  // namespace gazeloop::report::perfetto
