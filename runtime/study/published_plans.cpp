#include "runtime/study/published_plans.h"

#include <algorithm>
#include <cmath>

namespace gazeloop::study {
namespace {

/// First, first + step, ...
std::vector<double> levels(double first, double step, int count) {
    std::vector<double> list;
    list.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        // In whole hundredths, so that 1.2 + 3 * .2 is the double that 1.8 is.
        list.push_back(std::round((first + step * i) * 100.0) / 100.0);
    }
    return list;
}

Plan kfr(std::vector<double> sigmas) {
    return {.name = "",
            .design = Design::SameDifferent,
            .method = "kfr",
            .factors = {{.name = "sigma", .key = "kfr.sigma", .levels = std::move(sigmas)},
                        {.name = "alpha", .key = "kfr.alpha", .levels = {1, 2, 3, 4}}},
            .criterion = 0.8,
            .sessions = 3};
}

Plan kfr_pilot() {
    Plan plan = kfr(levels(1.0, 0.2, 14));
    plan.name = "kfr-pilot";
    plan.source =
        "Meng et al. 2018, 4.2. Not stated there, chosen here: time for an answer, rest, and how "
        "orders are balanced";
    plan.subjects = 24;
    plan.training = 20;
    plan.shown_s = 2.0;
    return plan;
}

Plan kfr_final() {
    Plan plan = kfr(levels(1.2, 0.2, 7));
    plan.name = "kfr-final";
    plan.source =
        "Meng et al. 2018, 4.3. Not stated there, chosen here: three sessions (as in 4.2), time "
        "for an answer, rest";
    plan.subjects = 18;
    plan.training = 5;
    plan.validation = 0.3;
    return plan;
}

/// The quality index j of the layers paper is 0.33 / MAR slope: 12 and 15 give its 0.0275 and
/// 0.022.
Factor quality_index(std::vector<double> indices) {
    return {.name = "j",
            .key = "acuity.mar",
            .levels = std::move(indices),
            .values = {},
            .quotient = 0.33};
}

Plan f3d(std::string name, Design design, std::vector<double> indices) {
    return {.name = std::move(name),
            .design = design,
            .method = "layers",
            .factors = {quality_index(std::move(indices))},
            .higher_is_better = true,
            .settings = {{"layers.s2_fixed", "true"}, {"render.camera", "fly-4"}},
            .subjects = 15,
            .black_s = 0.5,
            .gaze = {.follow = true}};
}

Plan f3d_pair() {
    Plan plan = f3d("f3d-pair", Design::Pair, levels(8, 1, 15));
    plan.source =
        "Guenter et al. 2012, 5. Chosen here: j = 0.33 / slope, which gives both published slopes; "
        "how the camera moves; time for an answer";
    plan.shown_s = 8.0;
    return plan;
}

Plan f3d_ramp() {
    Plan plan = f3d("f3d-ramp", Design::Ramp, {4, 5, 7, 10, 12, 15, 17, 22});
    plan.source =
        "Guenter et al. 2012, 5: from j0 = 22 and back. Chosen here: j = 0.33 / slope; steps are "
        "even in j; how the camera moves; time for an answer";
    plan.reference_method = "layers";
    plan.shown_s = 5.0;
    return plan;
}

Plan f3d_slider() {
    Plan plan = f3d("f3d-slider", Design::Slider, levels(4, 1, 19));
    plan.source =
        "Guenter et al. 2012, 5: six speeds of the camera, one that stands and pans, one that "
        "stands. Not stated there, chosen here: which speeds (each twice the last, 0.025 to 0.8 "
        "m/s); "
        "levels up to 22; j = 0.33 / slope";
    plan.settings.pop_back();
    plan.factors.push_back(
        {.name = "motion",
         .key = "render.camera",
         .levels = {1, 2, 3, 4, 5, 6, 7, 8},
         .values = {"still", "pan", "fly-1", "fly-2", "fly-3", "fly-4", "fly-5", "fly-6"}});
    plan.repeats = 2;
    plan.shown_s = 8.0;
    return plan;
}

}  // namespace

const std::vector<Plan>& published_plans() {
    static const std::vector<Plan> kPlans{kfr_pilot(), kfr_final(), f3d_pair(), f3d_ramp(),
                                          f3d_slider()};
    return kPlans;
}

const Plan* published_plan(std::string_view name) {
    const auto found = std::ranges::find(published_plans(), name, &Plan::name);
    return found == published_plans().end() ? nullptr : &*found;
}

}  // namespace gazeloop::study
