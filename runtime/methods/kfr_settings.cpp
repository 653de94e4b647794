#include "runtime/methods/kfr_settings.h"

#include <fmt/core.h>

#include <charconv>
#include <string_view>
#include <vector>

#include "runtime/methods/kernel_table_file.h"

namespace gazeloop::methods {
namespace {

Expected<std::vector<double>> numbers(std::string_view text) {
    std::vector<double> list;
    for (std::string_view left = text; !left.empty();) {
        const std::size_t comma = std::min(left.find(','), left.size());
        std::string_view item = left.substr(0, comma);
        left.remove_prefix(std::min(comma + 1, left.size()));
        while (item.starts_with(' ')) {
            item.remove_prefix(1);
        }
        double value = 0.0;
        const auto [end, error] = std::from_chars(item.data(), item.data() + item.size(), value);
        if (error != std::errc{} || end != item.data() + item.size()) {
            return std::unexpected(Error{
                ErrorKind::Usage,
                fmt::format("'{}': numbers with commas between are expected, e.g. 0.25,0.25,0.5",
                            text)});
        }
        list.push_back(value);
    }
    return list;
}

Expected<foveation::RadialKernel> polynomial_kernel(std::string_view text) {
    const auto coefficients = numbers(text);
    if (!coefficients) {
        return std::unexpected(coefficients.error());
    }
    auto polynomial = foveation::PolynomialKernel::create(*coefficients);
    if (!polynomial) {
        return std::unexpected(Error{polynomial.error().kind,
                                     fmt::format("'{}': {}", text, polynomial.error().message)});
    }
    return std::move(*polynomial);
}

Expected<foveation::RadialKernel> table_kernel(std::string_view samples) {
    auto table = read_kernel_samples(samples, "sample");
    if (!table) {
        return std::unexpected(table.error());
    }
    return std::move(*table);
}

Expected<foveation::RadialKernel> kernel(const settings::Settings& settings) {
    const auto& kfr = settings.values().kfr;
    if (kfr.kernel == "power") {
        return kfr.alpha;
    }
    if (kfr.kernel == "power-as-printed") {
        return foveation::PrintedPowerKernel{kfr.alpha};
    }
    if (kfr.kernel == "sin") {
        return foveation::SineKernel{};
    }
    if (kfr.kernel == "exp") {
        return foveation::ExponentialKernel{};
    }
    if (kfr.kernel == "polynomial") {
        return settings.at_origin("kfr.polynomial", polynomial_kernel(kfr.polynomial));
    }
    if (kfr.kernel_samples.empty()) {
        return settings.at_origin(
            "kfr.kernel",
            Expected<foveation::RadialKernel>(std::unexpected(Error{
                ErrorKind::Usage,
                "the table's file is missing; state it with kfr.kernel_table, or its samples with "
                "kfr.kernel_samples"})));
    }
    return settings.at_origin("kfr.kernel_samples", table_kernel(kfr.kernel_samples));
}

}  // namespace

Expected<void> take_kernel_table(settings::Settings& settings) {
    const std::string file = settings.values().kfr.kernel_table;
    if (settings.values().kfr.kernel != "table" || file.empty()) {
        return {};
    }
    const auto table = settings.at_origin("kfr.kernel_table", load_kernel_table(file));
    if (!table) {
        return std::unexpected(table.error());
    }
    if (auto set = settings.set("kfr.kernel_samples", kernel_samples(*table), file); !set) {
        return set;
    }
    return settings.set("kfr.kernel_table", "", "taken");
}

Expected<foveation::KfrParameters> kfr_parameters(const settings::Settings& settings) {
    auto made = kernel(settings);
    if (!made) {
        return std::unexpected(made.error());
    }
    const auto& kfr = settings.values().kfr;
    return foveation::KfrParameters{.sigma = kfr.sigma,
                                    .kernel = std::move(*made),
                                    .disc = kfr.disc,
                                    .border_px = kfr.border_px,
                                    .lp_width = static_cast<std::uint32_t>(kfr.lp_width),
                                    .lp_height = static_cast<std::uint32_t>(kfr.lp_height),
                                    .close_hole = kfr.close_hole};
}

}  // namespace gazeloop::methods
