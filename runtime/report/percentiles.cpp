#include "runtime/report/percentiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <optional>

namespace gazeloop::report {
namespace {

constexpr std::size_t kMost = 20;

/// A decimal number and nothing else, whatever the locale.
std::optional<double> number_of(std::string_view text) {
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [read_to, error] = std::from_chars(text.data(), end, value);
    return error == std::errc{} && read_to == end ? std::optional(value) : std::nullopt;
}

}  // namespace

Expected<Percentiles> Percentiles::parse(std::string_view text) {
    const auto refuse = [&](std::string_view what) {
        return std::unexpected(
            Error{ErrorKind::Usage,
                  fmt::format("--percentiles {}: {}: give percents above 0 and below 100, "
                              "ascending, as in --percentiles 50,95,99.9",
                              text, what)});
    };
    Percentiles percentiles;
    percentiles.percents_.clear();
    for (std::string_view rest = text;;) {
        const std::size_t comma = rest.find(',');
        const std::string_view part = rest.substr(0, comma);
        const std::size_t place = percentiles.percents_.size() + 1;
        const std::optional<double> percent = number_of(part);
        if (place > kMost) {
            return refuse(fmt::format("there are more than {}", kMost));
        }
        if (!percent) {
            return refuse(fmt::format("number {}, '{}', is no number", place, part));
        }
        if (!(*percent > 0.0 && *percent < 100.0)) {
            return refuse(fmt::format("number {}, '{}', is no percentile", place, part));
        }
        if (!percentiles.percents_.empty() && *percent <= percentiles.percents_.back()) {
            return refuse(fmt::format("number {}, '{}', is not above the one before", place, part));
        }
        percentiles.percents_.push_back(*percent);
        if (comma == std::string_view::npos) {
            return percentiles;
        }
        rest.remove_prefix(comma + 1);
    }
}

std::vector<std::string> Percentiles::names() const {
    std::vector<std::string> names;
    std::ranges::transform(percents_, std::back_inserter(names),
                           [](double percent) { return fmt::format("p{}", percent); });
    return names;
}

}  // namespace gazeloop::report
