#include "runtime/study/tell_published.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "runtime/report/output_file.h"
#include "runtime/report/summary_json.h"
#include "runtime/study/published_plans.h"
#include "runtime/study/published_results.h"
#include "runtime/study/trade_curves.h"

namespace gazeloop::study {

void tell_published(const PublishedRequest& request) {
    std::vector<PublishedResult> results;
    for (const std::string& file : request.trades) {
        bool any = false;
        std::string why;
        for (const Plan& plan : published_plans()) {
            auto curves = trade_curves(plan, file);
            if (!curves) {
                why = curves.error().message;
                continue;
            }
            SimulatedPeople people = request.people.people;
            people.curves = std::move(*curves);
            std::vector<PublishedResult> found = against_published(plan, people);
            results.insert(results.end(), found.begin(), found.end());
            any = true;
        }
        if (!any) {
            throw SetupError(
                ErrorKind::BadInput,
                fmt::format("{}: holds all levels of no published study: {}", file, why));
        }
    }
    if (request.json != "-") {
        value_or_throw(report::write_text("-", published_text(request.people.people, results)));
    }
    if (!request.json.empty()) {
        value_or_throw(report::write_text(
            request.json, report::json_text(published_json(request.people.people, results))));
    }
}

}  // namespace gazeloop::study
