#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "sim/observer.h"

namespace gazeloop::study {

/// Who was simulated, in a line, and as JSON.
[[nodiscard]] std::string people_text(const sim::ObserverTerms& terms);
[[nodiscard]] nlohmann::ordered_json people_json(const sim::ObserverTerms& terms);

}  // namespace gazeloop::study
