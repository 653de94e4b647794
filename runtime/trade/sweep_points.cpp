#include "runtime/trade/sweep_points.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "runtime/methods/registry.h"

namespace gazeloop::trade {
namespace {

std::unexpected<Error> refuse(std::string text) {
    return std::unexpected(Error{ErrorKind::Usage, std::move(text)});
}

/// What any method's pictures may be filtered by.
constexpr std::array<std::string_view, 7> kFilters{
    "render.footprint",   "render.footprint_taps",  "render.lp_gaussian",
    "render.post_filter", "render.specular_filter", "render.taa",
    "render.taa_reset"};

bool is_of_group(const std::string& key, const std::string& method) {
    return key.starts_with(method + '.');
}

/// Whether points of a method differ by a key: it is of the method's own group, or, where that is
/// the group of no method that is swept, one that the method uses too (layers that follow
/// acuity.mar), or a filter.
bool is_of(const std::string& key, const std::string& method,
           const std::vector<std::string>& methods) {
    if (is_filter(key)) {
        return true;
    }
    const bool of_one = std::ranges::any_of(
        methods, [&key](const std::string& one) { return is_of_group(key, one); });
    return of_one ? is_of_group(key, method) : methods::is_setting_of(key, method);
}

}  // namespace

bool is_filter(std::string_view key) { return std::ranges::find(kFilters, key) != kFilters.end(); }

std::string SweepPoint::settings_text() const {
    std::string text;
    for (const auto& [key, value] : settings) {
        text += fmt::format("{}{}={}", text.empty() ? "" : " ", key, value);
    }
    return text;
}

Expected<Varied> parse_varied(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == 0 || equals == std::string::npos) {
        return refuse(fmt::format("'{}' must be KEY=V1,V2,..., e.g. kfr.sigma=1.2,1.8", text));
    }
    Varied varied{.key = text.substr(0, equals), .values = {}};
    for (std::size_t from = equals + 1; from <= text.size();) {
        const std::size_t end = std::min(text.find(',', from), text.size());
        if (end == from) {
            return refuse(fmt::format("'{}' has an empty value", text));
        }
        varied.values.push_back(text.substr(from, end - from));
        if (std::ranges::find(varied.values.begin(), varied.values.end() - 1,
                              varied.values.back()) != varied.values.end() - 1) {
            return refuse(fmt::format("'{}' has {} twice", text, varied.values.back()));
        }
        from = end + 1;
    }
    if (varied.values.empty() || text.ends_with(',')) {
        return refuse(fmt::format("'{}' has an empty value", text));
    }
    return varied;
}

Expected<std::vector<SweepPoint>> sweep_points(const std::vector<std::string>& methods,
                                               const std::vector<Varied>& varied) {
    if (methods.empty()) {
        return refuse("there is nothing to sweep: name a method");
    }
    for (auto one = varied.begin(); one != varied.end(); ++one) {
        if (std::ranges::find(one + 1, varied.end(), one->key, &Varied::key) != varied.end()) {
            return refuse(fmt::format("{} is varied twice: give all its values at once", one->key));
        }
        if (std::ranges::none_of(methods,
                                 [&](const auto& m) { return is_of(one->key, m, methods); })) {
            return refuse(
                fmt::format("{} is a setting of none of the methods that are swept; what "
                            "all of them share is set with --set",
                            one->key));
        }
    }
    std::vector<SweepPoint> points;
    for (const std::string& method : methods) {
        std::vector<SweepPoint> of_method{{.method = method}};
        for (const Varied& one : varied) {
            if (!is_of(one.key, method, methods)) {
                continue;
            }
            if (of_method.size() * one.values.size() > kMostSweepPoints) {
                return refuse(fmt::format("over {} points: vary less at a time", kMostSweepPoints));
            }
            std::vector<SweepPoint> longer;
            for (const SweepPoint& point : of_method) {
                for (const std::string& value : one.values) {
                    longer.push_back(point);
                    longer.back().settings.emplace_back(one.key, value);
                }
            }
            of_method = std::move(longer);
        }
        points.insert(points.end(), of_method.begin(), of_method.end());
    }
    if (points.size() > kMostSweepPoints) {
        return refuse(fmt::format("over {} points: vary less at a time", kMostSweepPoints));
    }
    return points;
}

}  // namespace gazeloop::trade
