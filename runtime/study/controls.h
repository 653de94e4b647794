#pragma once

#include <optional>
#include <string>

#include "runtime/present/button_source.h"
#include "runtime/study/trial_clock.h"

namespace gazeloop::study {

/// What a key means while a design is asked; none: nothing. Capitals count as small letters.
[[nodiscard]] std::optional<Press> press_of(Design design, char key);
/// What a controller's button means: the design's presses in their order (TrialClock::presses), and
/// to go on. While there is rest, all buttons go on, since some controllers have few.
[[nodiscard]] std::optional<Press> press_of(Design design, present::Button button, Screen shown);

/// All of that, in a line for whoever conducts the study.
[[nodiscard]] std::string controls_text(Design design);

}  // namespace gazeloop::study
