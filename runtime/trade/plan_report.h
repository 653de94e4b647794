#pragma once

#include <string>
#include <vector>

#include "runtime/foveation/eye/acuity_model.h"
#include "runtime/foveation/eye/sufficiency.h"
#include "runtime/methods/method.h"
#include "runtime/report/line_chart.h"

namespace gazeloop::trade {

/// What plans are compared by: a display, an eye, a gaze, and models of the eye.
struct PlanQuestion {
    std::string display;
    gaze::Eye eye = gaze::Eye::Left;
    double azimuth_deg = 0.0;
    double elevation_deg = 0.0;
    double widening_deg = 0.0;   ///< the models' foveae are this much wider
    std::string widening_terms;  ///< what that is made of; may be empty
    const foveation::GazeField* field = nullptr;
    std::vector<const foveation::AcuityModel*> models;  ///< widened
};

struct PlanVerdict {
    foveation::Sufficiency sufficiency;
    double samples_over_fewest = 0.0;
};

struct PlanRow {
    std::string method;
    methods::PlannedMethod plan;
    std::vector<PlanVerdict> verdicts;  ///< by model
};

/// The answers: what each model needs at least, and what each method takes and offers.
struct PlanReport {
    PlanQuestion question;
    std::uint64_t display_pixels = 0;
    std::vector<double> fewest;  ///< by model
    std::vector<PlanRow> rows;
};

[[nodiscard]] PlanReport make_plan_report(PlanQuestion question, std::vector<PlanRow> rows);

[[nodiscard]] std::string plan_report_text(const PlanReport& report);
[[nodiscard]] std::string plan_report_json(const PlanReport& report);

/// Offered density by eccentricity of the methods, and what the models ask for, dashed.
[[nodiscard]] report::LineChart density_chart(const PlanReport& report);

}  // namespace gazeloop::trade
