#include "runtime/quality/flip.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <numeric>

#include "runtime/quality/convolution.h"

namespace gazeloop::quality {
namespace {

/// Linear Rec.709 to XYZ, columns as glm has them; the white of D65 is the sum of its columns.
const glm::mat3 kXyzFromRgb = glm::transpose(
    glm::mat3{10135552.0F / 24577794.0F, 8788810.0F / 24577794.0F, 4435075.0F / 24577794.0F,
              2613072.0F / 12288897.0F, 8788810.0F / 12288897.0F, 887015.0F / 12288897.0F,
              1425312.0F / 73733382.0F, 8788810.0F / 73733382.0F, 70074185.0F / 73733382.0F});
const glm::mat3 kRgbFromXyz = glm::inverse(kXyzFromRgb);
const glm::vec3 kWhite = kXyzFromRgb * glm::vec3(1.0F);

/// The paper's opponent space (section 4.1), linear in light: luminance, red-green, blue-yellow.
glm::vec3 opponent(const glm::vec3& rgb) {
    const glm::vec3 xyz = kXyzFromRgb * rgb / kWhite;
    return {116.0F * xyz.y - 16.0F, 500.0F * (xyz.x - xyz.y), 200.0F * (xyz.y - xyz.z)};
}

glm::vec3 rgb_of(const glm::vec3& opponent_colour) {
    const float y = (opponent_colour.x + 16.0F) / 116.0F;
    return kRgbFromXyz *
           (kWhite * glm::vec3(opponent_colour.y / 500.0F + y, y, y - opponent_colour.z / 200.0F));
}

float lab_curve(float x) {
    constexpr float kDelta = 6.0F / 29.0F;
    return x > kDelta * kDelta * kDelta ? std::cbrt(x)
                                        : x / (3.0F * kDelta * kDelta) + 4.0F / 29.0F;
}

/// CIELAB with its chroma scaled by lightness, after Hunt (section 4.1.2).
glm::vec3 hunt_lab(const glm::vec3& rgb) {
    const glm::vec3 xyz = kXyzFromRgb * rgb / kWhite;
    const glm::vec3 f(lab_curve(xyz.x), lab_curve(xyz.y), lab_curve(xyz.z));
    const float lightness = 116.0F * f.y - 16.0F;
    return {lightness, 0.01F * lightness * 500.0F * (f.x - f.y),
            0.01F * lightness * 200.0F * (f.y - f.z)};
}

float hyab(const glm::vec3& a, const glm::vec3& b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

/// One of the contrast sensitivity functions, as sums of Gaussians over degrees (table 1).
struct Gaussian {
    double a;
    double b;
};
constexpr Gaussian kLuminance{1.0, 0.0047};
constexpr Gaussian kRedGreen{1.0, 0.0053};
constexpr std::array<Gaussian, 2> kBlueYellow{Gaussian{34.1, 0.04}, Gaussian{13.5, 0.025}};

/// A Gaussian's profile over pixels, its square the amplitude that the paper gives it in 2D.
std::vector<double> profile(const Gaussian& gaussian, double pixels_per_degree) {
    constexpr double kPi = std::numbers::pi;
    // All kernels are as wide as the widest Gaussian asks for.
    const auto reach = static_cast<int>(
        std::ceil(3.0 * std::sqrt(kBlueYellow[0].b / (2.0 * kPi * kPi)) * pixels_per_degree));
    const double amplitude = std::sqrt(gaussian.a * std::sqrt(kPi / gaussian.b));
    std::vector<double> values;
    for (int i = -reach; i <= reach; ++i) {
        const double x_deg = i / pixels_per_degree;
        values.push_back(amplitude * std::exp(-kPi * kPi * x_deg * x_deg / gaussian.b));
    }
    return values;
}

Kernel scaled(const std::vector<double>& values, double scale) {
    Kernel kernel;
    for (const double value : values) {
        kernel.push_back(static_cast<float>(value * scale));
    }
    return kernel;
}

double sum_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Filters by a sum of Gaussians whose weights sum to 1.
template <std::size_t N>
Plane sensed(const Plane& plane, const std::array<Gaussian, N>& gaussians, double pixels_per_degree,
             const RowWork& work) {
    std::array<std::vector<double>, N> profiles;
    double total = 0.0;
    for (std::size_t i = 0; i < N; ++i) {
        profiles[i] = profile(gaussians[i], pixels_per_degree);
        total += sum_of(profiles[i]) * sum_of(profiles[i]);
    }
    Plane result(plane.width, plane.height);
    for (const std::vector<double>& values : profiles) {
        const Kernel kernel = scaled(values, 1.0 / std::sqrt(total));
        const Plane part = convolved(plane, kernel, kernel, work);
        for (std::size_t at = 0; at < part.values.size(); ++at) {
            result.values[at] += part.values[at];
        }
    }
    return result;
}

/// Detectors of edges (first derivative of a Gaussian) and points (second), across and along
/// (section 4.2).
struct FeatureKernels {
    Kernel smooth;
    Kernel edge;
    Kernel point;

    explicit FeatureKernels(double pixels_per_degree) {
        constexpr double kWidthDeg = 0.082;
        const double sigma_px = 0.5 * kWidthDeg * pixels_per_degree;
        const auto reach = static_cast<int>(std::ceil(3.0 * sigma_px));
        std::vector<double> gauss;
        std::vector<double> first;
        std::vector<double> second;
        for (int i = -reach; i <= reach; ++i) {
            const double x = i / sigma_px;
            gauss.push_back(std::exp(-0.5 * x * x));
            first.push_back(-x * gauss.back());
            second.push_back((x * x - 1.0) * gauss.back());
        }
        smooth = scaled(gauss, 1.0 / sum_of(gauss));
        edge = balanced(first);
        point = balanced(second);
    }

  private:
    /// Positive weights sum to 1, negative ones to -1.
    static Kernel balanced(const std::vector<double>& values) {
        double positive = 0.0;
        double negative = 0.0;
        for (const double value : values) {
            (value > 0.0 ? positive : negative) += std::abs(value);
        }
        Kernel kernel;
        for (const double value : values) {
            const double sum = value > 0.0 ? positive : negative;
            kernel.push_back(static_cast<float>(sum > 0.0 ? value / sum : 0.0));
        }
        return kernel;
    }
};

/// The strength of edges and points at each pixel.
struct Features {
    Plane edges;
    Plane points;
};

Plane magnitude(const Plane& lightness, const Kernel& across, const Kernel& along,
                const RowWork& work) {
    Plane x = convolved(lightness, across, along, work);
    const Plane y = convolved(lightness, along, across, work);
    for (std::size_t at = 0; at < x.values.size(); ++at) {
        x.values[at] = std::hypot(x.values[at], y.values[at]);
    }
    return x;
}

/// A picture as FLIP sees it.
struct Seen {
    std::array<Plane, 3> colour;  ///< Hunt-adjusted CIELAB of what the eye's filters leave
    Features features;
};

Seen see(const render::LinearPicture& picture, double pixels_per_degree, const RowWork& work) {
    std::array<Plane, 3> channels{Plane(picture.width, picture.height),
                                  Plane(picture.width, picture.height),
                                  Plane(picture.width, picture.height)};
    Plane lightness(picture.width, picture.height);
    const auto for_pixels = [&](const auto& each) {
        work.over(picture.height, [&](std::uint32_t from, std::uint32_t to) {
            for (std::size_t at = std::size_t{from} * picture.width;
                 at < std::size_t{to} * picture.width; ++at) {
                each(at);
            }
        });
    };
    for_pixels([&](std::size_t at) {
        const glm::vec3 colour = opponent(glm::clamp(picture.pixels[at], 0.0F, 1.0F));
        channels[0].values[at] = colour.x;
        channels[1].values[at] = colour.y;
        channels[2].values[at] = colour.z;
        lightness.values[at] = (colour.x + 16.0F) / 116.0F;
    });
    Seen seen;
    seen.colour[0] = sensed(channels[0], std::array{kLuminance}, pixels_per_degree, work);
    seen.colour[1] = sensed(channels[1], std::array{kRedGreen}, pixels_per_degree, work);
    seen.colour[2] = sensed(channels[2], kBlueYellow, pixels_per_degree, work);
    for_pixels([&](std::size_t at) {
        const glm::vec3 rgb = rgb_of(
            {seen.colour[0].values[at], seen.colour[1].values[at], seen.colour[2].values[at]});
        const glm::vec3 lab = hunt_lab(glm::clamp(rgb, 0.0F, 1.0F));
        seen.colour[0].values[at] = lab.x;
        seen.colour[1].values[at] = lab.y;
        seen.colour[2].values[at] = lab.z;
    });
    const FeatureKernels kernels(pixels_per_degree);
    seen.features = {magnitude(lightness, kernels.edge, kernels.smooth, work),
                     magnitude(lightness, kernels.point, kernels.smooth, work)};
    return seen;
}

constexpr float kColourExponent = 0.7F;   // q_c
constexpr float kFeatureExponent = 0.5F;  // q_f

/// Takes a distance of colours to [0, 1]: the first 40 % of the range are spread over 95 % of it
/// (section 4.1.3).
class ColourScale {
  public:
    ColourScale()
        : most_(std::pow(hyab(hunt_lab({0.0F, 1.0F, 0.0F}), hunt_lab({0.0F, 0.0F, 1.0F})),
                         kColourExponent)) {}

    [[nodiscard]] float operator()(float distance) const {
        constexpr float kShare = 0.4F;   // p_c
        constexpr float kTaken = 0.95F;  // p_t
        const float knee = kShare * most_;
        const float powered = std::pow(distance, kColourExponent);
        return powered < knee ? powered * kTaken / knee
                              : kTaken + (powered - knee) / (most_ - knee) * (1.0F - kTaken);
    }

  private:
    float most_;
};

}  // namespace

Expected<FlipResult> ldr_flip(const render::LinearPicture& reference,
                              const render::LinearPicture& test, double pixels_per_degree,
                              const RowWork& work) {
    if (!(pixels_per_degree >= kFlipLeastPixelsPerDegree &&
          pixels_per_degree <= kFlipMostPixelsPerDegree)) {  // true for NaN
        return std::unexpected(
            Error{ErrorKind::Usage,
                  fmt::format("FLIP: {} pixels per degree: must lie in [{}, {}]", pixels_per_degree,
                              kFlipLeastPixelsPerDegree, kFlipMostPixelsPerDegree)});
    }
    const Seen a = see(reference, pixels_per_degree, work);
    const Seen b = see(test, pixels_per_degree, work);
    const ColourScale scale;
    FlipResult result{.mean = 0.0, .map = Plane(reference.width, reference.height)};
    std::vector<double> row_sums(reference.height);
    work.over(reference.height, [&](std::uint32_t from, std::uint32_t to) {
        for (std::uint32_t y = from; y < to; ++y) {
            for (std::size_t at = std::size_t{y} * reference.width;
                 at < (std::size_t{y} + 1) * reference.width; ++at) {
                const auto lab = [at](const Seen& seen) {
                    return glm::vec3(seen.colour[0].values[at], seen.colour[1].values[at],
                                     seen.colour[2].values[at]);
                };
                const float colour = scale(hyab(lab(a), lab(b)));
                const float feature = std::pow(
                    std::max(
                        std::abs(a.features.edges.values[at] - b.features.edges.values[at]),
                        std::abs(a.features.points.values[at] - b.features.points.values[at])) /
                        std::numbers::sqrt2_v<float>,
                    kFeatureExponent);
                const float difference = std::pow(colour, 1.0F - feature);
                result.map.values[at] = difference;
                row_sums[y] += static_cast<double>(difference);
            }
        }
    });
    result.mean = std::accumulate(row_sums.begin(), row_sums.end(), 0.0) /
                  static_cast<double>(result.map.values.size());
    return result;
}

}  // namespace gazeloop::quality
