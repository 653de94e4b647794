#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace gazeloop::report::perfetto {

/// Identifies a track within a trace; 0 is none.
using TrackId = std::uint64_t;

/// Places of texts that a trace holds once (TraceWriter gives them); 0 is none.
enum class NameId : std::uint64_t {};  ///< of an event
enum class KeyId : std::uint64_t {};   ///< of an annotation
enum class TextId : std::uint64_t {};  ///< of an annotation's value

struct Annotation {
    KeyId key{};
    std::variant<std::uint64_t, double, TextId, std::string_view> value;
};

/// The values are those of TrackEvent.Type in track_event.proto.
enum class EventType : std::uint8_t {
    SliceBegin = 1,
    SliceEnd = 2,  ///< of the innermost open slice of its track
    Instant = 3,
    Counter = 4,
};

/// An arrow goes from each event of a flow to the next one in time.
struct Flow {
    std::uint64_t id = 0;
    bool ends = false;  ///< with this event
};

/// What is more than kMost is left out: who makes events has fewer.
class Annotations {
  public:
    static constexpr std::size_t kMost = 4;

    void add(KeyId key, decltype(Annotation::value) value) {
        if (count_ < kMost) {
            all_[count_++] = {key, value};
        }
    }
    [[nodiscard]] std::span<const Annotation> list() const { return std::span(all_).first(count_); }

  private:
    std::array<Annotation, kMost> all_{};
    std::size_t count_ = 0;
};

/// One event on one track.
struct TraceEvent {
    EventType type = EventType::Instant;
    TrackId track = 0;
    std::int64_t ns = 0;      ///< see drawable_time()
    NameId name{};            ///< of slices' begins and instants
    std::string_view text{};  ///< their name where it is not one of a few; used if name is none
    double value = 0.0;       ///< of counters
    std::optional<Flow> flow{};
    Annotations annotations{};
};

/// Whether a reader takes an event at this time: it drops negative ones. Half of the range is left
/// for what readers add to times.
[[nodiscard]] constexpr bool drawable_time(std::int64_t ns) {
    constexpr std::int64_t kMost_ns = std::int64_t{1} << 62;
    return ns >= 0 && ns < kMost_ns;
}

struct TrackDescription {
    TrackId id = 0;
    TrackId parent = 0;
    std::string name;
    std::string description{};
    std::int32_t rank = 0;              ///< among the parent's tracks
    std::optional<std::string> unit{};  ///< a counter's, which this then is
};

}  // namespace gazeloop::report::perfetto
