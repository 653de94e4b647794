#include "runtime/numerics/maps_of_interest.h"

#include <fmt/core.h>

#include <numbers>

namespace gazeloop::numerics {

std::vector<NamedKernel> kernels_under_test(bool quick) {
    std::vector<NamedKernel> list;
    const std::vector<double> alphas =
        quick ? std::vector{0.5, 4.0} : std::vector{0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0};
    list.reserve(alphas.size());
    for (const double alpha : alphas) {
        list.push_back({fmt::format("B {}", alpha), alpha});
    }
    const std::vector<double> printed = quick ? std::vector{4.0} : std::vector{1.0, 4.0, 16.0};
    for (const double alpha : printed) {
        list.push_back({fmt::format("A {}", alpha), foveation::PrintedPowerKernel{alpha}});
    }
    using Coefficients = std::vector<double>;
    for (const Coefficients& coefficients :
         {Coefficients{0.25, 0.25, 0.5}, Coefficients{0.0, 3.0, -2.0}}) {
        list.push_back(
            {fmt::format("polynomial {},{},{}", coefficients[0], coefficients[1], coefficients[2]),
             value_or_throw(foveation::PolynomialKernel::create(coefficients))});
    }
    list.push_back({"sin", foveation::RadialKernel(foveation::SineKernel{})});
    list.push_back({"exp", foveation::RadialKernel(foveation::ExponentialKernel{})});
    const std::vector<foveation::TableKernel::Sample> samples{
        {0, 0}, {0.4, 0.05}, {0.7, 0.3}, {1, 1}};
    list.push_back({"table of 4", foveation::TableKernel::create(samples).value()});
    return list;
}

gaze::EyeView headset_view(foveation::ImageSize image) {
    constexpr double kDegree = std::numbers::pi / 180.0;
    return {.fov = {-52.0 * kDegree, 48.0 * kDegree, 50.0 * kDegree, -50.0 * kDegree},
            .width_px = image.width_px,
            .height_px = image.height_px};
}

}  // namespace gazeloop::numerics
