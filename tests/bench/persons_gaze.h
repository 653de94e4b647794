#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "runtime/trade/sweep_question.h"

namespace gazeloop::bench {

/// What a simulated person does while a method is measured. Nothing was chosen on this one:
/// settings of methods were chosen with seed 1.
enum class PersonsGaze : std::uint8_t {
    OverASaccade,  ///< from six frames before the first one of over 4 degrees on
    InFixation
};

/// So many frames of a scene as the person sees it, the head swaying; a sample for each frame.
/// @throws SetupError (Usage) where the person makes no saccade
trade::CaseQuestion seen_by_person(std::string_view scene, PersonsGaze gaze, std::size_t frames,
                                   double frame_seconds);

}  // namespace gazeloop::bench
