#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/error.h"
#include "runtime/foveation/eye/mar_line.h"
#include "runtime/foveation/picture/gaze_field.h"
#include "runtime/foveation/picture/offered_density.h"
#include "runtime/methods/method_settings.h"
#include "runtime/settings/settings.h"

namespace gazeloop::methods {

/// What a method is to plan: one eye's picture at one gaze.
struct PlanSubject {
    const MethodSettings& values;
    const settings::Settings& settings;  ///< that hold the rows of `values`
    const foveation::GazeField& field;
    foveation::MarLine line;
};

struct PlanFigure {
    std::string name;
    double value = 0.0;
};

/// What one method shades, and what that offers the eye.
struct PlannedMethod {
    std::string parameters;     ///< "sigma 1.8, alpha 4, disc"
    std::uint64_t samples = 0;  ///< shaded for one picture
    std::unique_ptr<foveation::OfferedDensity> density;
    std::vector<PlanFigure> figures{};  ///< of the method's own
    std::string useless{};              ///< why its parameters make no useful picture; or empty
};

/// A method that `plan` knows. A new one is a function and a row in plan_methods.cpp.
struct PlanMethod {
    std::string_view name;
    /// Errors (Usage): settings that the picture does not allow.
    Expected<PlannedMethod> (*plan)(const PlanSubject& subject);
};

/// All of them, full resolution first.
[[nodiscard]] std::span<const PlanMethod> plan_methods();

}  // namespace gazeloop::methods
