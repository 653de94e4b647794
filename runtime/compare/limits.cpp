#include "runtime/compare/limits.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "runtime/quality/figure_keys.h"

namespace gazeloop::compare {
namespace {

Limit parse_limit(const std::string& text) {
    const std::size_t equals = text.find('=');
    Limit limit{.key = text.substr(0, equals), .value = 0.0};
    const char* const end = text.data() + text.size();
    const char* const begin = equals == std::string::npos ? end : text.data() + equals + 1;
    const auto [stopped, error] = std::from_chars(begin, end, limit.value);
    if (error != std::errc{} || stopped != end || !std::isfinite(limit.value)) {
        throw SetupError(
            ErrorKind::Usage,
            fmt::format("--limit: '{}' must be FIGURE=NUMBER, e.g. contrast=0.5", text));
    }
    return limit;
}

}  // namespace

std::vector<Limit> parse_limits(const std::vector<std::string>& texts,
                                const quality::MetricChoice& metrics) {
    std::vector<Limit> limits;
    for (const std::string& text : texts) {
        limits.push_back(parse_limit(text));
        value_or_throw(quality::check_figure(limits.back().key, metrics));
    }
    return limits;
}

bool within(const std::vector<Limit>& limits, const std::vector<quality::QualityFigure>& figures) {
    bool kept = true;
    for (const Limit& limit : limits) {
        const auto found = std::ranges::find(figures, limit.key, &quality::QualityFigure::key);
        const bool worse =
            found->lower_is_better ? found->mean > limit.value : found->mean < limit.value;
        if (worse) {
            spdlog::error("{} is {:.4f}, worse than the limit of {:g}", limit.key, found->mean,
                          limit.value);
            kept = false;
        }
    }
    return kept;
}

}  // namespace gazeloop::compare
