#include "runtime/report/perfetto/trace_writer.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <protozero/buffer_fixed.hpp>
#include <protozero/pbf_writer.hpp>
#include <type_traits>
#include <utility>

#include "runtime/report/perfetto/proto_fields.h"

namespace gazeloop::report::perfetto {
namespace {

using protozero::basic_pbf_writer;
using protozero::pbf_writer;

constexpr std::uint32_t kSequence = 1;
constexpr std::size_t kPiece = std::size_t{256} << 10U;
/// 70 bytes, and 30 for each annotation, at most.
constexpr std::size_t kMostOfShortEvent = 70 + 30 * Annotations::kMost;

/// A packet of the sequence, in the making.
template <typename Buffer>
class Packet {
  public:
    Packet(Buffer& buffer, std::uint32_t flags)
        : trace_(buffer), fields_(trace_, proto::trace::kPacket) {
        fields_.add_uint32(proto::packet::kSequenceId, kSequence);
        fields_.add_uint32(proto::packet::kSequenceFlags, flags);
    }
    [[nodiscard]] basic_pbf_writer<Buffer>& fields() { return fields_; }

  private:
    basic_pbf_writer<Buffer> trace_;
    basic_pbf_writer<Buffer> fields_;
};

template <typename Buffer>
void write(basic_pbf_writer<Buffer>& event, const Annotation& annotation) {
    basic_pbf_writer<Buffer> fields(event, proto::track_event::kAnnotations);
    fields.add_uint64(proto::annotation::kNameIid, std::to_underlying(annotation.key));
    std::visit(
        [&fields](const auto& value) {
            using Value = std::remove_cvref_t<decltype(value)>;
            if constexpr (std::is_same_v<Value, std::uint64_t>) {
                fields.add_uint64(proto::annotation::kUint, value);
            } else if constexpr (std::is_same_v<Value, double>) {
                fields.add_double(proto::annotation::kDouble, value);
            } else if constexpr (std::is_same_v<Value, TextId>) {
                fields.add_uint64(proto::annotation::kTextIid, std::to_underlying(value));
            } else {
                fields.add_string(proto::annotation::kText, value.data(), value.size());
            }
        },
        annotation.value);
}

template <typename Buffer>
void write(Buffer& buffer, const TraceEvent& event) {
    Packet packet(buffer, proto::sequence_flags::kNeedsIncrementalState);
    packet.fields().add_uint64(proto::packet::kTimestamp, static_cast<std::uint64_t>(event.ns));
    basic_pbf_writer<Buffer> fields(packet.fields(), proto::packet::kTrackEvent);
    fields.add_enum(proto::track_event::kType, std::to_underlying(event.type));
    fields.add_uint64(proto::track_event::kTrackUuid, event.track);
    if (event.name != NameId{}) {
        fields.add_uint64(proto::track_event::kNameIid, std::to_underlying(event.name));
    } else if (!event.text.empty()) {
        fields.add_string(proto::track_event::kName, event.text.data(), event.text.size());
    }
    if (event.type == EventType::Counter) {
        fields.add_double(proto::track_event::kDoubleCounterValue, event.value);
    }
    if (event.flow) {
        fields.add_fixed64(event.flow->ends ? proto::track_event::kTerminatingFlowIds
                                            : proto::track_event::kFlowIds,
                           event.flow->id);
    }
    for (const Annotation& annotation : event.annotations.list()) {
        write(fields, annotation);
    }
}

/// Of an event with texts of its own nobody knows how long it is.
bool is_short(const TraceEvent& event) {
    return event.text.empty() &&
           std::ranges::none_of(event.annotations.list(), [](const Annotation& annotation) {
               return std::holds_alternative<std::string_view>(annotation.value);
           });
}

}  // namespace

TraceWriter::TraceWriter(TraceClock clock, Sink sink) : clock_(clock), sink_(std::move(sink)) {
    buffer_.reserve(kPiece + (std::size_t{16} << 10U));
}

NameId TraceWriter::name(std::string_view text) {
    return NameId{intern(names_, proto::interned_data::kEventNames, text)};
}
KeyId TraceWriter::key(std::string_view text) {
    return KeyId{intern(keys_, proto::interned_data::kAnnotationNames, text)};
}
TextId TraceWriter::text(std::string_view text) {
    return TextId{intern(texts_, proto::interned_data::kAnnotationTexts, text)};
}

std::uint64_t TraceWriter::intern(Table& table, std::uint32_t field, std::string_view text) {
    if (const auto known = table.find(text); known != table.end()) {
        return known->second;
    }
    const std::uint64_t iid = table.size() + 1;
    table.emplace(text, iid);
    Packet packet(buffer_, proto::sequence_flags::kNeedsIncrementalState);
    pbf_writer data(packet.fields(), proto::packet::kInternedData);
    pbf_writer entry(data, field);
    entry.add_uint64(proto::interned::kIid, iid);
    entry.add_string(proto::interned::kText, text.data(), text.size());
    return iid;
}

void TraceWriter::add(const TrackDescription& track) {
    Packet packet(buffer_, proto::sequence_flags::kNeedsIncrementalState);
    pbf_writer fields(packet.fields(), proto::packet::kTrackDescriptor);
    fields.add_uint64(proto::track_descriptor::kUuid, track.id);
    fields.add_string(proto::track_descriptor::kName, track.name);
    if (track.parent != 0) {
        fields.add_uint64(proto::track_descriptor::kParentUuid, track.parent);
    }
    if (track.unit) {
        pbf_writer counter(fields, proto::track_descriptor::kCounter);
        counter.add_string(proto::counter_descriptor::kUnitName, *track.unit);
    }
    fields.add_enum(proto::track_descriptor::kChildOrdering, proto::child_ordering::kExplicit);
    fields.add_int32(proto::track_descriptor::kSiblingOrderRank, track.rank);
    if (!track.description.empty()) {
        fields.add_string(proto::track_descriptor::kDescription, track.description);
    }
}

void TraceWriter::add(const TraceEvent& event) {
    if (!started_) {
        start(event.ns);
    }
    if (is_short(event)) {
        // Faster than byte by byte into the string.
        std::array<char, kMostOfShortEvent>
            bytes;  // NOLINT(cppcoreguidelines-pro-type-member-init)
        protozero::fixed_size_buffer_adaptor packet(bytes.data(), bytes.size());
        write(packet, event);
        buffer_.append(packet.data(), packet.size());
    } else {
        write(buffer_, event);
    }
    if (buffer_.size() >= kPiece) {
        hand_over();
    }
}

/// What the buffer holds came before the first event, and the snapshot of the clock before that.
void TraceWriter::start(std::int64_t first_ns) {
    started_ = true;
    std::string first;
    {
        Packet packet(first, proto::sequence_flags::kIncrementalStateCleared);
        packet.fields().add_bool(proto::packet::kFirstOnSequence, true);
        if (clock_ == TraceClock::Monotonic) {
            {
                pbf_writer defaults(packet.fields(), proto::packet::kDefaults);
                defaults.add_uint32(proto::defaults::kTimestampClockId,
                                    proto::clock_id::kMonotonic);
            }
            pbf_writer snapshot(packet.fields(), proto::packet::kClockSnapshot);
            {
                pbf_writer clock(snapshot, proto::clock_snapshot::kClocks);
                clock.add_uint32(proto::clock::kClockId, proto::clock_id::kMonotonic);
                clock.add_uint64(proto::clock::kTimestamp, static_cast<std::uint64_t>(first_ns));
            }
            snapshot.add_enum(proto::clock_snapshot::kPrimaryTraceClock,
                              static_cast<std::int32_t>(proto::clock_id::kMonotonic));
        }
    }
    buffer_.insert(0, first);
}

void TraceWriter::hand_over() {
    handed_over_ += buffer_.size();
    sink_(buffer_);
    buffer_.clear();
}

void TraceWriter::finish() {
    if (!started_) {
        start(0);
    }
    hand_over();
}

}  // namespace gazeloop::report::perfetto
