#include "runtime/study/controls.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <vector>

namespace gazeloop::study {
namespace {

char key_for(Press press) {
    constexpr std::array<char, kPressNames.size()> kKeys{'s', 'd', '1', '2', 'u', 'd',
                                                         '+', '-', 'r', 'e', 'x', 'g'};
    return kKeys[static_cast<std::size_t>(press)];
}

std::string_view name_of(Press press) { return kPressNames[static_cast<std::size_t>(press)]; }

}  // namespace

std::optional<Press> press_of(Design design, char key) {
    const char small = key >= 'A' && key <= 'Z' ? static_cast<char>(key - 'A' + 'a') : key;
    std::vector<Press> presses = TrialClock::presses(design);
    presses.push_back(Press::GoOn);
    const auto found = std::ranges::find(presses, small, key_for);
    return found == presses.end() ? std::nullopt : std::optional(*found);
}

std::optional<Press> press_of(Design design, present::Button button, Screen shown) {
    if (button == present::Button::GoOn || shown == Screen::Rest) {
        return Press::GoOn;
    }
    const std::vector<Press> presses = TrialClock::presses(design);
    const auto place = static_cast<std::size_t>(button);
    return place < presses.size() ? std::optional(presses[place]) : std::nullopt;
}

std::string controls_text(Design design) {
    std::string keys;
    std::string buttons;
    for (const Press press : TrialClock::presses(design)) {
        keys += fmt::format("{}: {}, ", key_for(press), name_of(press));
        buttons += fmt::format("{}{}", buttons.empty() ? "" : ", ", name_of(press));
    }
    return fmt::format(
        "{}{}: go on after a rest; on a controller (A, B, X, Y, right shoulder of a gamepad): {}; "
        "any goes on",
        keys, key_for(Press::GoOn), buttons);
}

}  // namespace gazeloop::study
