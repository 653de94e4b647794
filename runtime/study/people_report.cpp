#include "runtime/study/people_report.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

namespace gazeloop::study {

std::string people_text(const sim::ObserverTerms& terms) {
    return fmt::format(
        "Simulated people: noise {:g}, bias {:g}, lapse {:g}, fatigue {:g}/h, people {:g}",
        terms.noise, terms.bias, terms.lapse, terms.fatigue, terms.people);
}

nlohmann::ordered_json people_json(const sim::ObserverTerms& terms) {
    return {{"noise", terms.noise},
            {"bias", terms.bias},
            {"lapse", terms.lapse},
            {"fatigue_per_hour", terms.fatigue},
            {"people", terms.people}};
}

}  // namespace gazeloop::study
