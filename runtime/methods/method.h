#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/error.h"
#include "runtime/foveation/eye/mar_line.h"
#include "runtime/foveation/picture/gaze_field.h"
#include "runtime/foveation/picture/image_size.h"
#include "runtime/foveation/picture/offered_density.h"
#include "runtime/methods/method_settings.h"
#include "runtime/render/passes/make_passes.h"
#include "runtime/settings/settings.h"

namespace gazeloop::methods {

/// What a method is to plan for people to look at: one eye's picture at one gaze.
struct PlanSubject {
    const MethodSettings& values;
    const settings::Settings& settings;  ///< that hold the rows of `values`
    const foveation::GazeField& field;
    foveation::MarLine line;

    [[nodiscard]] foveation::ImageSize image() const {
        return {field.view().width_px, field.view().height_px};
    }
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

/// A way to spend samples: one file binds all that the program needs to know of it.
struct Method {
    std::string_view name;         ///< in render.method
    std::string_view description;  ///< one line

    /// Rows of its settings, which lie in MethodSettings; null: it has none.
    std::vector<settings::SettingRow> (*rows)(MethodSettings& values) = nullptr;

    /// Whether acuity.mar decides its samples.
    bool follows_acuity = false;

    /// What it would shade and offer. Errors (Usage): settings that the picture does not allow.
    Expected<PlannedMethod> (*plan)(const PlanSubject& subject) = nullptr;

    /// Whether its pictures depend on where the foveae are.
    bool uses_gaze = true;

    /// Refuses parameters by which no picture of this size is worth drawing (Usage); null: there
    /// are none.
    Expected<void> (*check_picture)(const MethodSettings& values,
                                    const settings::Settings& settings,
                                    foveation::ImageSize image) = nullptr;

    /// What renders by it; null: it is planned only. Errors: settings that cannot be (Usage), what
    /// they name (BadInput).
    Expected<render::MakePasses> (*passes)(const MethodSettings& values,
                                           const settings::Settings& settings) = nullptr;
};

}  // namespace gazeloop::methods
