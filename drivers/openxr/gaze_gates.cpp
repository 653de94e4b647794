#include "drivers/openxr/gaze_gates.h"

#include <fmt/format.h>

#include <utility>

#include "runtime/time/span.h"

namespace gazeloop::drivers {
namespace {

struct GateText {
    std::string_view what;
    std::string_view remedy;
};

constexpr std::array<GateText, kGazeGateCount> kTexts{{
    {"extension listed",
     "use a runtime that knows eye gaze (XR_RUNTIME_JSON), or another source of gaze (--gaze)"},
    {"system supports it",
     "use a headset with an eye tracker, switch the tracker on in the runtime's settings, or use "
     "another source of gaze (--gaze)"},
    {"action bound",
     "see in the runtime's settings whether it lets programs have eye gaze, or has it bound to "
     "something else"},
    {"session focused", "put the headset on, and close what lies above the picture (a menu)"},
    {"action active",
     "put the headset on, allow eye tracking for this program, and let the runtime calibrate it"},
    {"pose valid",
     "let the runtime calibrate the tracker, and see that the headset sits well and the eyes are "
     "open"},
    {"sample time known",
     "nothing to do for a user: this runtime does not say when the eye was seen, so the age of "
     "the gaze is unknown; the gaze itself is used"},
}};

std::size_t index(GazeGate gate) { return static_cast<std::size_t>(gate); }

}  // namespace

std::string_view describe(GazeGate gate) { return kTexts[index(gate)].what; }
std::string_view remedy(GazeGate gate) { return kTexts[index(gate)].remedy; }

void GazeGates::set(GazeGate gate, const GateState& state, std::int64_t now_ns) {
    Gate& of = gates_[index(gate)];
    of.now = state;
    if (of.told == of.now) {
        return;
    }
    const auto passed_ns = time::saturated(static_cast<__int128>(now_ns) - of.window_begin_ns);
    if (!of.told || passed_ns >= kWindow_ns) {
        of.window_begin_ns = now_ns;
        of.told_in_window = 0;
    }
    if (of.told_in_window == kMostChanges) {
        return;
    }
    ++of.told_in_window;
    of.told = of.now;
    events_.push_back({{now_ns, time::StampKind::Measured},
                       fmt::format("eye gaze: {}: {} ({})", describe(gate),
                                   state.open ? "yes" : "no", state.found)});
}

const std::optional<GateState>& GazeGates::state(GazeGate gate) const {
    return gates_[index(gate)].now;
}

std::optional<GazeGate> GazeGates::first_shut() const {
    for (std::size_t i = 0; i < gates_.size(); ++i) {
        if (!gates_[i].now || !gates_[i].now->open) {
            return static_cast<GazeGate>(i);
        }
    }
    return std::nullopt;
}

std::vector<SourceEvent> GazeGates::take_events() { return std::exchange(events_, {}); }

}  // namespace gazeloop::drivers
