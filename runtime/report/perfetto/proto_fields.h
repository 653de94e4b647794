#pragma once

#include <cstdint>

/// Field numbers of the messages of a Perfetto trace that are written here, and values of their
/// enumerations. From protos/perfetto/trace of github.com/google/perfetto, of 2026: trace.proto,
/// trace_packet.proto, clock_snapshot.proto, interned_data.proto, and of track_event/:
/// track_event.proto, track_descriptor.proto, counter_descriptor.proto, debug_annotation.proto.
namespace gazeloop::report::perfetto::proto {

namespace trace {
inline constexpr std::uint32_t kPacket = 1;
}  // namespace trace

namespace packet {
inline constexpr std::uint32_t kClockSnapshot = 6;
inline constexpr std::uint32_t kTimestamp = 8;
inline constexpr std::uint32_t kSequenceId = 10;
inline constexpr std::uint32_t kTrackEvent = 11;
inline constexpr std::uint32_t kInternedData = 12;
inline constexpr std::uint32_t kSequenceFlags = 13;
inline constexpr std::uint32_t kDefaults = 59;
inline constexpr std::uint32_t kTrackDescriptor = 60;
inline constexpr std::uint32_t kFirstOnSequence = 87;
}  // namespace packet

namespace defaults {
inline constexpr std::uint32_t kTimestampClockId = 58;
}  // namespace defaults

namespace sequence_flags {
inline constexpr std::uint32_t kIncrementalStateCleared = 1;
inline constexpr std::uint32_t kNeedsIncrementalState = 2;
}  // namespace sequence_flags

namespace clock_snapshot {
inline constexpr std::uint32_t kClocks = 1;
inline constexpr std::uint32_t kPrimaryTraceClock = 2;
}  // namespace clock_snapshot

namespace clock {
inline constexpr std::uint32_t kClockId = 1;
inline constexpr std::uint32_t kTimestamp = 2;
}  // namespace clock

namespace clock_id {
inline constexpr std::uint32_t kMonotonic = 3;
}  // namespace clock_id

namespace interned_data {
inline constexpr std::uint32_t kEventNames = 2;
inline constexpr std::uint32_t kAnnotationNames = 3;
inline constexpr std::uint32_t kAnnotationTexts = 29;
}  // namespace interned_data

/// EventName and DebugAnnotationName have the name, InternedString the bytes, at the same number.
namespace interned {
inline constexpr std::uint32_t kIid = 1;
inline constexpr std::uint32_t kText = 2;
}  // namespace interned

namespace track_descriptor {
inline constexpr std::uint32_t kUuid = 1;
inline constexpr std::uint32_t kName = 2;
inline constexpr std::uint32_t kParentUuid = 5;
inline constexpr std::uint32_t kCounter = 8;
inline constexpr std::uint32_t kChildOrdering = 11;
inline constexpr std::uint32_t kSiblingOrderRank = 12;
inline constexpr std::uint32_t kDescription = 14;
}  // namespace track_descriptor

namespace child_ordering {
inline constexpr std::int32_t kExplicit = 3;
}  // namespace child_ordering

namespace counter_descriptor {
inline constexpr std::uint32_t kUnitName = 6;
}  // namespace counter_descriptor

namespace track_event {
inline constexpr std::uint32_t kAnnotations = 4;
inline constexpr std::uint32_t kType = 9;
inline constexpr std::uint32_t kNameIid = 10;
inline constexpr std::uint32_t kTrackUuid = 11;
inline constexpr std::uint32_t kName = 23;
inline constexpr std::uint32_t kDoubleCounterValue = 44;
inline constexpr std::uint32_t kFlowIds = 47;
inline constexpr std::uint32_t kTerminatingFlowIds = 48;
}  // namespace track_event

namespace annotation {
inline constexpr std::uint32_t kNameIid = 1;
inline constexpr std::uint32_t kUint = 3;
inline constexpr std::uint32_t kDouble = 5;
inline constexpr std::uint32_t kText = 6;
inline constexpr std::uint32_t kTextIid = 17;
}  // namespace annotation

}  // namespace gazeloop::report::perfetto::proto
