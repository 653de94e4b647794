#include "runtime/statistics/cochrans_q.h"

#include "runtime/statistics/chi_square.h"

namespace gazeloop::statistics {

double p_of_cochrans_q(double q, std::size_t treatments) {
    return chi_square_tail(q, static_cast<unsigned>(treatments - 1));
}

std::optional<CochransQ> cochrans_q(const BinaryAnswers& answers) {
    const std::size_t k = answers.treatments;
    if (k < 2 || answers.answers.empty() || answers.answers.size() % k != 0) {
        return std::nullopt;
    }
    std::vector<double> of_treatment(k);
    double total = 0.0;
    double squares_of_subjects = 0.0;
    for (std::size_t subject = 0; subject < answers.answers.size(); subject += k) {
        double yeses = 0.0;
        for (std::size_t treatment = 0; treatment < k; ++treatment) {
            const double yes = answers.answers[subject + treatment] != 0 ? 1.0 : 0.0;
            of_treatment[treatment] += yes;
            yeses += yes;
        }
        total += yeses;
        squares_of_subjects += yeses * yeses;
    }
    double squares_of_treatments = 0.0;
    for (const double yeses : of_treatment) {
        squares_of_treatments += yeses * yeses;
    }
    const auto count = static_cast<double>(k);
    const double variation = count * total - squares_of_subjects;
    if (!(variation > 0.0)) {
        return std::nullopt;
    }
    CochransQ result{
        .q = (count - 1.0) * (count * squares_of_treatments - total * total) / variation,
        .degrees_of_freedom = static_cast<unsigned>(k - 1),
        .p = 1.0};
    result.p = p_of_cochrans_q(result.q, k);
    return result;
}

}  // namespace gazeloop::statistics
