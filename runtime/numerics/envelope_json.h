#pragma once

#include <string>

#include "runtime/numerics/envelope.h"

namespace gazeloop::numerics {

/// Every row with every figure, as JSON.
std::string envelope_json(const Envelope& envelope);

}  // namespace gazeloop::numerics
