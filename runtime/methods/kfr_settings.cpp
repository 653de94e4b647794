#include "runtime/methods/kfr_settings.h"

#include <fmt/core.h>

#include <charconv>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/methods/kernel_table_file.h"
#include "runtime/methods/only_under.h"

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

Expected<foveation::RadialKernel> kernel(const KfrSettings& kfr, const settings::Settings& all) {
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
        return all.at_origin("kfr.polynomial", polynomial_kernel(kfr.polynomial));
    }
    if (kfr.kernel_samples.empty()) {
        return all.at_origin(
            "kfr.kernel",
            Expected<foveation::RadialKernel>(std::unexpected(Error{
                ErrorKind::Usage,
                "the table's file is missing; state it with kfr.kernel_table, or its samples with "
                "kfr.kernel_samples"})));
    }
    return all.at_origin("kfr.kernel_samples", table_kernel(kfr.kernel_samples));
}

}  // namespace

std::vector<settings::SettingRow> rows_of(KfrSettings& kfr) {
    using foveation::KfrParameters;
    using foveation::PowerKernel;
    using settings::Choice;
    using settings::Concerns;
    using settings::Number;
    using settings::Whole;
    const settings::OnlyWhile only = only_under({"kfr", "kfr3d", "interleaved"});
    return {
        {"kfr.alpha", "exponent of the kernels power (x^alpha) and power-as-printed",
         Number{&kfr.alpha, PowerKernel::kMinAlpha, PowerKernel::kMaxAlpha}, Concerns::Picture,
         only},
        {"kfr.aspect",
         "LP-buffer width / height, as many texels; 0: the picture's, and .35 if interleaved",
         Number{&kfr.aspect, 0.0, KfrParameters::kMaxAspect}, Concerns::Picture, only},
        {"kfr.border_px", "width of the blend between disc and LP-buffer, px",
         Number{&kfr.border_px, 0.0, 64.0}, Concerns::Picture, only},
        {"kfr.close_hole", "without the disc: still shade the kernel's hole at the fovea directly",
         &kfr.close_hole, Concerns::Picture, only},
        {"kfr.disc", "shade pixels directly where the LP-buffer has at least one texel per pixel",
         &kfr.disc, Concerns::Picture, only},
        {"kfr.kernel", "kernel: how columns spread from the fovea",
         Choice{.value = &kfr.kernel,
                .names = {foveation::kKernelNames.begin(), foveation::kKernelNames.end()}},
         Concerns::Picture, only},
        {"kfr.kernel_samples", "samples of the kernel table: x,y;x,y;... from 0,0 to 1,1",
         Choice{.value = &kfr.kernel_samples}, Concerns::Picture, only},
        {"kfr.kernel_table", "a .csv or .toml file with the samples of the kernel table",
         settings::Path{&kfr.kernel_table, ""}, Concerns::Picture, only},
        {"kfr.lp_height", "rows of the LP-buffer; 0: by kfr.sigma and kfr.aspect",
         Whole{&kfr.lp_height, 0, foveation::LpSize::kMaxSide}, Concerns::Picture, only},
        {"kfr.lp_width", "columns of the LP-buffer; 0: by kfr.sigma and kfr.aspect",
         Whole{&kfr.lp_width, 0, foveation::LpSize::kMaxSide}, Concerns::Picture, only},
        {"kfr.polynomial", "coefficients of the kernel polynomial, of x, x^2, ...; sum 1",
         settings::NumberList{&kfr.polynomial}, Concerns::Picture, only},
        {"kfr.sigma", "picture width / LP-buffer width",
         Number{&kfr.sigma, KfrParameters::kMinSigma, KfrParameters::kMaxSigma}, Concerns::Picture,
         only},
    };
}

Expected<void> check_kfr(const settings::Settings& all) {
    if (!all.is_built_in("kfr.kernel")) {
        return {};
    }
    // Nobody has chosen the kernel that these are for.
    for (const auto& [key, kernel] :
         {std::pair{"kfr.kernel_table", "table"}, std::pair{"kfr.kernel_samples", "table"},
          std::pair{"kfr.polynomial", "polynomial"}}) {
        if (!all.is_built_in(key)) {
            return std::unexpected(
                Error{ErrorKind::Usage,
                      fmt::format("{}: has no effect while {}: set kfr.kernel={} too",
                                  all.with_origin(key), all.with_origin("kfr.kernel"), kernel)});
        }
    }
    return {};
}

Expected<void> take_kernel_table(const KfrSettings& kfr, settings::Settings& all) {
    const std::string file = kfr.kernel_table;
    if (kfr.kernel != "table" || file.empty()) {
        return {};
    }
    const auto table = all.at_origin("kfr.kernel_table", load_kernel_table(file));
    if (!table) {
        return std::unexpected(table.error());
    }
    if (auto set = all.set("kfr.kernel_samples", kernel_samples(*table), file); !set) {
        return set;
    }
    return all.set("kfr.kernel_table", "", "taken");
}

Expected<foveation::KfrParameters> parameters(const KfrSettings& kfr,
                                              const settings::Settings& all) {
    auto made = kernel(kfr, all);
    if (!made) {
        return std::unexpected(made.error());
    }
    return foveation::KfrParameters{.sigma = kfr.sigma,
                                    .kernel = std::move(*made),
                                    .disc = kfr.disc,
                                    .border_px = kfr.border_px,
                                    .lp_width = static_cast<std::uint32_t>(kfr.lp_width),
                                    .lp_height = static_cast<std::uint32_t>(kfr.lp_height),
                                    .aspect = kfr.aspect,
                                    .close_hole = kfr.close_hole};
}

}  // namespace gazeloop::methods
