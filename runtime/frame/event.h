#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace gazeloop::frame {

/// How much a user wants to know of an event.
enum class EventWeight : std::uint8_t {
    Routine,  ///< every run has such: for the recording and for who looks for a fault
    Notice,   ///< worth a line
    Warning,  ///< something is not as it should be
};

/// One kind of event: one word of at most 32 bytes, which recordings hold.
struct EventKind {
    std::string_view name;
    EventWeight weight = EventWeight::Routine;
};

// Of the loop and its observers.
inline constexpr EventKind kGazeEvent{"gaze", EventWeight::Routine};  ///< counted by state anyway
inline constexpr EventKind kGazeSourceEvent{"gaze-source", EventWeight::Routine};
inline constexpr EventKind kGpuClockEvent{"gpu-clock", EventWeight::Routine};
inline constexpr EventKind kHiddenAreaEvent{"hidden-area", EventWeight::Routine};
inline constexpr EventKind kErrorEvent{"error", EventWeight::Routine};  ///< said by itself
inline constexpr EventKind kTrackerEvent{"tracker", EventWeight::Notice};
/// It is there, and cannot be used.
inline constexpr EventKind kTrackerFaultEvent{"tracker-fault", EventWeight::Warning};
/// Its gaze has no direction until something that it does not state is set.
inline constexpr EventKind kUnplacedGazeEvent{"gaze-unplaced", EventWeight::Warning};
inline constexpr EventKind kAxesEvent{"axes", EventWeight::Warning};
inline constexpr EventKind kTraceEvent{"trace", EventWeight::Routine};  ///< a block of its own
/// What a scene's work lacks, since nothing shown needs it: of the whole run, without a time.
inline constexpr EventKind kLeftOutEvent{"left-out", EventWeight::Notice};
/// How a light field's frames waited for views, the one that nobody sees among them: of the whole
/// run, without a time.
inline constexpr EventKind kViewsEvent{"views", EventWeight::Notice};
inline constexpr EventKind kClockEvent{"clock", EventWeight::Warning};
inline constexpr EventKind kDisplayEvent{"display", EventWeight::Warning};
inline constexpr EventKind kBudgetBrokenEvent{"budget-broken", EventWeight::Warning};
inline constexpr EventKind kBudgetKeptEvent{"budget-kept", EventWeight::Notice};
inline constexpr EventKind kQualityLevelEvent{"quality-level", EventWeight::Notice};
/// Frames take longer than they may, and no level that is allowed takes less.
inline constexpr EventKind kQualityFloorEvent{"quality-floor", EventWeight::Warning};

// Of a runtime and its session.
inline constexpr EventKind kSessionEvent{"session", EventWeight::Routine};  ///< its states
inline constexpr EventKind kMaskEvent{"visibility-mask", EventWeight::Notice};
inline constexpr EventKind kOriginEvent{"origin", EventWeight::Warning};
inline constexpr EventKind kHeadLostEvent{"head-lost", EventWeight::Warning};
inline constexpr EventKind kHeadFoundEvent{"head-found", EventWeight::Notice};
inline constexpr EventKind kViewOddEvent{"view-odd", EventWeight::Warning};
inline constexpr EventKind kViewGoodEvent{"view-good", EventWeight::Notice};
inline constexpr EventKind kDisplayTimeOddEvent{"display-time-odd", EventWeight::Warning};
inline constexpr EventKind kDisplayTimeGoodEvent{"display-time-good", EventWeight::Notice};
inline constexpr EventKind kPeriodOddEvent{"period-odd", EventWeight::Warning};
inline constexpr EventKind kFrameDiscardedEvent{"frame-discarded", EventWeight::Warning};
inline constexpr EventKind kFrameRefusedEvent{"frame-refused", EventWeight::Warning};
inline constexpr EventKind kEventsLostEvent{"events-lost", EventWeight::Warning};
inline constexpr EventKind kSessionOddEvent{"session-odd", EventWeight::Warning};

inline constexpr std::array kEventKinds{
    kGazeEvent,         kGazeSourceEvent,     kGpuClockEvent,
    kHiddenAreaEvent,   kErrorEvent,          kTrackerEvent,
    kAxesEvent,         kTraceEvent,          kClockEvent,
    kDisplayEvent,      kBudgetBrokenEvent,   kBudgetKeptEvent,
    kSessionEvent,      kMaskEvent,           kOriginEvent,
    kHeadLostEvent,     kHeadFoundEvent,      kViewOddEvent,
    kViewGoodEvent,     kDisplayTimeOddEvent, kDisplayTimeGoodEvent,
    kPeriodOddEvent,    kFrameDiscardedEvent, kFrameRefusedEvent,
    kEventsLostEvent,   kSessionOddEvent,     kTrackerFaultEvent,
    kQualityLevelEvent, kQualityFloorEvent,   kLeftOutEvent,
    kUnplacedGazeEvent, kViewsEvent};

/// A kind that is not known (of a later version's recording) is worth a line.
[[nodiscard]] constexpr EventWeight weight_of(std::string_view kind) {
    const auto* const known = std::ranges::find(kEventKinds, kind, &EventKind::name);
    return known != kEventKinds.end() ? known->weight : EventWeight::Notice;
}

/// What a target says of itself; who asks for it says when that was.
struct Event {
    EventKind kind;
    std::string text;
};

}  // namespace gazeloop::frame
