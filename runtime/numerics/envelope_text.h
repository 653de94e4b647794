#pragma once

#include <string>

#include "runtime/numerics/envelope.h"

namespace gazeloop::numerics {

/// The envelope for a person: one line per map, picture size and place of the fovea.
std::string envelope_text(const Envelope& envelope);

/// In a sentence: whether every target is met, and what random draws found.
std::string verdict(const Envelope& envelope);

}  // namespace gazeloop::numerics
