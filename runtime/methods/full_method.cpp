#include <utility>

#include "runtime/foveation/plans/full_plan.h"
#include "runtime/methods/method.h"
#include "runtime/render/passes/full_passes.h"

namespace gazeloop::methods {
namespace {

Expected<PlannedMethod> plan(const PlanSubject& subject) {
    const foveation::ImageSize image = subject.image();
    return PlannedMethod{.parameters = "",
                         .samples = std::uint64_t{image.width_px} * image.height_px,
                         .density = std::make_unique<foveation::FullDensity>()};
}

Expected<render::MakePasses> passes(const MethodSettings& /*values*/,
                                    const settings::Settings& /*settings*/) {
    return render::make_full_passes;
}

}  // namespace

Method full_method() {
    return {.name = "full",
            .description = "every pixel, by its own samples",
            .plan = plan,
            .uses_gaze = false,
            .passes = passes};
}

}  // namespace gazeloop::methods
