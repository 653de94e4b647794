#pragma once

#include <string>

#include "runtime/numerics/envelope.h"

namespace gazeloop::numerics {

/// The envelope as one page that needs nothing else: plots as inline SVG, and the table.
std::string envelope_html(const Envelope& envelope);

}  // namespace gazeloop::numerics
