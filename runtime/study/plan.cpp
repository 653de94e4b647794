#include "runtime/study/plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace gazeloop::study {
namespace {

std::unexpected<Error> bad(std::string message) {
    return std::unexpected(Error{ErrorKind::BadInput, std::move(message)});
}

bool one_word(std::string_view text) {
    return !text.empty() && text.size() <= 32 && std::ranges::all_of(text, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '_' || c == '-' || c == '.';
    });
}

Expected<void> check_factor(const Plan& plan, std::size_t at) {
    const Factor& factor = plan.factors[at];
    const std::string where = fmt::format("factor {} ({})", at + 1, factor.name);
    if (!one_word(factor.name)) {
        return bad(fmt::format("factor {}: name must be one word of letters and digits", at + 1));
    }
    for (std::size_t before = 0; before < at; ++before) {
        if (plan.factors[before].name == factor.name) {
            return bad(fmt::format("{}: two factors have this name", where));
        }
    }
    if (factor.levels.empty()) {
        return bad(fmt::format("{}: levels are missing, e.g. levels = [1.2, 1.8]", where));
    }
    for (std::size_t i = 0; i < factor.levels.size(); ++i) {
        if (!std::isfinite(factor.levels[i]) ||
            (i > 0 && !(factor.levels[i] > factor.levels[i - 1]))) {
            return bad(fmt::format("{}: levels must be numbers that rise", where));
        }
    }
    if (!factor.values.empty() && factor.values.size() != factor.levels.size()) {
        return bad(fmt::format("{}: {} values for {} levels", where, factor.values.size(),
                               factor.levels.size()));
    }
    if (factor.by_session && at == 0) {
        return bad(
            fmt::format("{}: the first factor is judged within a session: by_session cannot "
                        "be true",
                        where));
    }
    if (!std::isfinite(factor.quotient) ||
        (factor.quotient != 0.0 && factor.levels.front() <= 0.0)) {
        return bad(fmt::format("{}: a quotient needs levels above 0", where));
    }
    return {};
}

struct Range {
    std::string_view key;
    double value;
    double least;
    double greatest;
};

Expected<void> check_ranges(const Plan& plan) {
    for (const Range& range :
         {Range{"criterion", plan.criterion, 0.01, 0.99},
          Range{"subjects", static_cast<double>(plan.subjects), 1, 10'000},
          Range{"sessions", static_cast<double>(plan.sessions), 1, 1000},
          Range{"repeats", static_cast<double>(plan.repeats), 1, 10'000},
          Range{"training", static_cast<double>(plan.training), 0, 1000},
          Range{"validation", plan.validation, 0.0, 0.9},
          Range{"most_failed", plan.most_failed, 0.0, 1.0},
          Range{"shown_s", plan.shown_s, 0.1, 600.0}, Range{"black_s", plan.black_s, 0.0, 60.0},
          Range{"answer_s", plan.answer_s, 0.0, 600.0}, Range{"rest_s", plan.rest_s, 0.0, 3600.0},
          Range{"steps", static_cast<double>(plan.steps), 2, 100},
          Range{"gaze.target_deg", plan.gaze.target_deg, 0.1, 180.0},
          Range{"gaze.most_off_s", plan.gaze.most_off_s, 0.0, 600.0},
          Range{"gaze.most_lost_s", plan.gaze.most_lost_s, 0.0, 600.0},
          Range{"gaze.most_attempts", static_cast<double>(plan.gaze.most_attempts), 1, 100}}) {
        if (!(range.value >= range.least && range.value <= range.greatest)) {
            return bad(fmt::format("{} is {:g}, which must lie between {:g} and {:g}", range.key,
                                   range.value, range.least, range.greatest));
        }
    }
    return {};
}

}  // namespace

bool is_of_all_methods(std::string_view key) {
    return key == "render.scene" || key == "render.camera";
}

std::string Factor::value_of(double level) const {
    if (!values.empty()) {
        return values[index_of(level)];
    }
    // Twelve digits: of what a quotient has more, the last are rounding.
    return quotient != 0.0 ? fmt::format("{:.12g}", quotient / level) : fmt::format("{}", level);
}

std::size_t Factor::index_of(double level) const {
    const auto nearest =
        std::ranges::min_element(levels, {}, [level](double one) { return std::abs(one - level); });
    return static_cast<std::size_t>(nearest - levels.begin());
}

std::size_t Plan::cells() const {
    std::size_t cells = 1;
    for (const Factor& factor : factors) {
        cells *= factor.levels.size();
    }
    return cells;
}

std::size_t Plan::cells_of_session() const {
    std::size_t cells = 1;
    for (const Factor& factor : factors) {
        cells *= factor.by_session ? 1 : factor.levels.size();
    }
    return cells;
}

unsigned Plan::least_sessions() const {
    std::size_t least = 1;
    for (const Factor& factor : factors) {
        if (factor.by_session) {
            least = std::max(least, factor.levels.size());
        }
    }
    return static_cast<unsigned>(least);
}

bool Plan::reference_varies() const {
    return std::ranges::any_of(factors.begin() + 1, factors.end(),
                               [](const Factor& factor) { return is_of_all_methods(factor.key); });
}

std::size_t Plan::conditions() const { return cells() / factors.front().levels.size(); }

std::vector<double> Plan::levels_of(std::size_t cell) const {
    std::vector<double> levels(factors.size());
    for (std::size_t at = factors.size(); at-- > 0;) {
        const std::vector<double>& all = factors[at].levels;
        levels[at] = all[cell % all.size()];
        cell /= all.size();
    }
    return levels;
}

double Plan::x_of(double level) const { return logarithmic ? std::log(level) : level; }

double Plan::level_at(double x) const { return logarithmic ? std::exp(x) : x; }

Expected<void> check(const Plan& plan) {
    if (!one_word(plan.name)) {
        return bad("name must be one word of letters and digits");
    }
    if (plan.factors.empty()) {
        return bad("there is no [[factor]]: a study varies something");
    }
    double cells = 1.0;
    for (std::size_t at = 0; at < plan.factors.size(); ++at) {
        if (auto checked = check_factor(plan, at); !checked) {
            return checked;
        }
        cells *= static_cast<double>(plan.factors[at].levels.size());
    }
    const Factor& first = plan.factors.front();
    if (first.key.empty()) {
        return bad(fmt::format(
            "factor 1 ({}): key is missing: the first factor sets what is judged", first.name));
    }
    if (plan.logarithmic && first.levels.front() <= 0.0) {
        return bad(fmt::format("factor 1 ({}): levels must be above 0, or logarithmic = false",
                               first.name));
    }
    if (first.levels.size() < 2) {
        return bad(fmt::format("factor 1 ({}): a threshold lies between levels: two are needed",
                               first.name));
    }
    if (plan.design == Design::Ramp && !first.values.empty()) {
        return bad("a ramp steps between levels: its first factor takes no list of values");
    }
    if (auto ranges = check_ranges(plan); !ranges) {
        return ranges;
    }
    if (plan.sessions < plan.least_sessions()) {
        return bad(
            fmt::format("sessions is {}, and {} are needed to show each level of a factor "
                        "that has one in a session (scenes, by_session): sessions = {}, or a "
                        "[[factor]] without by_session, whose levels are all shown in each",
                        plan.sessions, plan.least_sessions(), plan.least_sessions()));
    }
    const double trials = static_cast<double>(plan.cells_of_session()) * plan.sessions *
                          plan.repeats * 2.0 / (1.0 - plan.validation);
    if (cells > static_cast<double>(kMostCells) || trials > static_cast<double>(kMostTrials)) {
        return bad(
            fmt::format("{:.0f} cells and up to {:.0f} trials per subject are more than {} "
                        "and {}",
                        cells, trials, kMostCells, kMostTrials));
    }
    return {};
}

}  // namespace gazeloop::study
