#include "runtime/trade/setting_fit.h"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>

namespace gazeloop::trade {
namespace {

using Eigen::Index;
using Rows = std::vector<const SweepRow*>;
constexpr double kPercent = 100.0;

std::optional<double> positive_number(const std::string& text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool all = error == std::errc{} && end == text.data() + text.size();
    return all && value > 0.0 && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

const std::string* text_of(const SweepRow& row, const std::string& key) {
    for (const auto& [name, text] : row.point.settings) {
        if (name == key) {
            return &text;
        }
    }
    return nullptr;
}

/// The settings that can be terms of a law, and why others cannot.
std::vector<std::string> terms_of(const Rows& rows, std::vector<std::string>& notes) {
    std::vector<std::string> terms;
    for (const auto& [key, first] : rows.front()->point.settings) {
        bool numbers = true;
        bool varies = false;
        for (const SweepRow* const row : rows) {
            const std::string* const text = text_of(*row, key);
            numbers = numbers && text != nullptr && positive_number(*text);
            varies = varies || text == nullptr || *text != first;
        }
        if (!varies) {
            continue;
        }
        if (numbers) {
            terms.push_back(key);
        } else {
            notes.push_back(key + " is left out: not all of its values are numbers above 0");
        }
    }
    return terms;
}

/// What residuals, as logarithms of measured over fitted, come to.
template <typename Fit>
void judge(Fit& fit, const std::vector<double>& residuals, const Rows& rows, std::size_t terms) {
    double squares = 0.0;
    for (std::size_t i = 0; i < residuals.size(); ++i) {
        squares += residuals[i] * residuals[i];
        const double percent = kPercent * std::abs(std::expm1(residuals[i]));
        if (percent >= fit.worst_percent) {
            fit.worst_percent = percent;
            fit.worst_at = rows[i]->point.settings_text();
        }
    }
    fit.standard_error_percent =
        kPercent * std::expm1(std::sqrt(squares / static_cast<double>(residuals.size() - terms)));
}

std::optional<Eigen::VectorXd> solved(const Eigen::MatrixXd& terms, const Eigen::VectorXd& wanted) {
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(terms);
    constexpr double kIndependent = 1e-9;
    solver.setThreshold(kIndependent);
    if (solver.rank() < terms.cols()) {
        return std::nullopt;
    }
    return solver.solve(wanted);
}

std::optional<PowerLaw> law_of(const Rows& rows, const std::vector<std::string>& terms,
                               std::string quantity,
                               const std::function<double(const SweepRow&)>& value_of) {
    const auto count = static_cast<Index>(rows.size());
    Eigen::MatrixXd logs(count, static_cast<Index>(terms.size()) + 1);
    Eigen::VectorXd wanted(count);
    for (Index i = 0; i < count; ++i) {
        const SweepRow& row = *rows[static_cast<std::size_t>(i)];
        wanted(i) = std::log(value_of(row));
        if (!std::isfinite(wanted(i))) {
            return std::nullopt;
        }
        logs(i, 0) = 1.0;
        for (std::size_t term = 0; term < terms.size(); ++term) {
            logs(i, static_cast<Index>(term) + 1) =
                std::log(*positive_number(*text_of(row, terms[term])));
        }
    }
    const auto found = solved(logs, wanted);
    if (!found) {
        return std::nullopt;
    }
    PowerLaw law{.quantity = std::move(quantity), .factor = std::exp((*found)(0))};
    for (std::size_t term = 0; term < terms.size(); ++term) {
        law.exponents.emplace_back(terms[term], (*found)(static_cast<Index>(term) + 1));
    }
    const Eigen::VectorXd residuals = wanted - logs * *found;
    judge(law, {residuals.begin(), residuals.end()}, rows, terms.size() + 1);
    return law;
}

std::optional<TimeLine> line_of(const Rows& rows) {
    const auto count = static_cast<Index>(rows.size());
    Eigen::MatrixXd terms(count, 2);
    for (Index i = 0; i < count; ++i) {
        const SweepRow& row = *rows[static_cast<std::size_t>(i)];
        if (!(row.time.median_ms > 0.0)) {
            return std::nullopt;
        }
        terms(i, 0) = 1.0 / row.time.median_ms;
        terms(i, 1) = row.cells / row.time.median_ms;
    }
    const auto found = solved(terms, Eigen::VectorXd::Ones(count));
    if (!found) {
        return std::nullopt;
    }
    constexpr double kNsPerMs = 1e6;
    TimeLine line{.fixed_ms = (*found)(0), .ns_per_cell = (*found)(1) * kNsPerMs};
    std::vector<double> residuals;
    for (const SweepRow* const row : rows) {
        const double fitted = (*found)(0) + (*found)(1) * row->cells;
        if (!(fitted > 0.0)) {
            return std::nullopt;
        }
        residuals.push_back(std::log(row->time.median_ms / fitted));
    }
    judge(line, residuals, rows, 2);
    return line;
}

MethodFit fit_of(const std::string& method, const Rows& rows) {
    MethodFit fit{.method = method, .points = rows.size()};
    const std::vector<std::string> terms = terms_of(rows, fit.notes);
    if (terms.empty()) {
        fit.notes.emplace_back("no law: no setting with numbers varies");
    } else if (rows.size() < terms.size() + 2) {
        fit.notes.push_back(fmt::format("no law: {} points for {} terms, and one more is needed",
                                        rows.size(), terms.size() + 1));
    } else {
        const auto add = [&](const std::string& quantity,
                             const std::function<double(const SweepRow&)>& value_of) {
            if (auto law = law_of(rows, terms, quantity, value_of)) {
                fit.laws.push_back(std::move(*law));
            } else {
                fit.notes.push_back(
                    quantity +
                    ": no law, since the settings do not vary independently or it is "
                    "not a number above 0 everywhere");
            }
        };
        add("cells_per_frame", [](const SweepRow& row) { return row.cells; });
        add("time_ms", [](const SweepRow& row) { return row.time.median_ms; });
        add(rows.front()->figures.front().key,
            [](const SweepRow& row) { return row.figures.front().mean; });
    }
    constexpr std::size_t kFewest = 3;
    if (rows.size() >= kFewest) {
        fit.time = line_of(rows);
    }
    return fit;
}

}  // namespace

std::vector<MethodFit> setting_fits(const std::vector<SweepRow>& rows) {
    std::vector<std::pair<std::string, Rows>> methods;
    for (const SweepRow& row : rows) {
        if (!row.error.empty()) {
            continue;
        }
        auto found =
            std::ranges::find(methods, row.point.method, &std::pair<std::string, Rows>::first);
        if (found == methods.end()) {
            methods.emplace_back(row.point.method, Rows{});
            found = std::prev(methods.end());
        }
        found->second.push_back(&row);
    }
    std::vector<MethodFit> fits;
    for (const auto& [method, of_method] : methods) {
        if (of_method.size() > 1) {
            fits.push_back(fit_of(method, of_method));
        }
    }
    return fits;
}

}  // namespace gazeloop::trade
