#pragma once

#include <nlohmann/json.hpp>

#include "runtime/numerics/envelope.h"

namespace gazeloop::numerics {

/// Every row with every figure.
nlohmann::ordered_json envelope_json(const Envelope& envelope);

}  // namespace gazeloop::numerics
