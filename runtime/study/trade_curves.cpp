#include "runtime/study/trade_curves.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "runtime/open_for_reading.h"

namespace gazeloop::study {
namespace {

using Json = nlohmann::json;

/// Whether a point was drawn with a cell's levels: numbers may be written in other ways.
bool is_cell(const Json& point, const Plan& plan, const std::vector<double>& levels) {
    if (point.value("method", "") != plan.method) {
        return false;
    }
    const Json& settings = point.at("settings");
    for (std::size_t at = 0; at < plan.factors.size(); ++at) {
        const Factor& factor = plan.factors[at];
        if (factor.key.empty() || is_of_all_methods(factor.key)) {
            continue;  // no method's: the trade was made with its own
        }
        const std::string asked = factor.value_of(levels[at]);
        const std::string drawn = settings.value(factor.key, "");
        char* end = nullptr;
        const double number = std::strtod(drawn.c_str(), &end);
        const bool same_number =
            end != drawn.c_str() && *end == '\0' &&
            std::abs(number - std::strtod(asked.c_str(), nullptr)) <= 1e-9 * std::abs(number);
        if (drawn != asked && !same_number) {
            return false;
        }
    }
    return true;
}

std::optional<double> contrast_of(const Json& points, const Plan& plan,
                                  const std::vector<double>& levels) {
    for (const Json& point : points) {
        if (is_cell(point, plan, levels)) {
            const Json& mean = point.at("figures").at("contrast").at("mean");
            return mean.is_number() ? std::optional(mean.get<double>()) : std::nullopt;
        }
    }
    return std::nullopt;
}

}  // namespace

Expected<std::vector<DifferenceCurve>> trade_curves(const Plan& plan,
                                                    const std::filesystem::path& file) {
    const auto bad = [&file](std::string_view what) {
        return std::unexpected(
            Error{ErrorKind::BadInput, fmt::format("{}: {}", file.string(), what)});
    };
    auto in = open_for_reading(file);
    if (!in) {
        return bad(fmt::format("cannot be read ({})", in.error()));
    }
    try {
        const Json points = Json::parse(*in).at("points");
        std::vector<DifferenceCurve> curves(plan.conditions());
        for (std::size_t cell = 0; cell < plan.cells(); ++cell) {
            const std::vector<double> levels = plan.levels_of(cell);
            const auto contrast = contrast_of(points, plan, levels);
            if (!contrast) {
                return bad(fmt::format(
                    "has no contrast of {} with {} {:g} (cell {} of the plan): "
                    "gazeloop trade --json FILE --methods {} --vary KEY=... "
                    "for each factor makes one",
                    plan.method, plan.factors.front().name, levels.front(), cell + 1, plan.method));
            }
            curves[cell % plan.conditions()].points.push_back(
                {.x = plan.x_of(levels.front()), .difference = *contrast});
        }
        return curves;
    } catch (const Json::exception&) {
        return bad("is no result of gazeloop trade --json");
    }
}

}  // namespace gazeloop::study
