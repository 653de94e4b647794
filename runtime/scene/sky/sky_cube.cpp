#include "runtime/scene/sky/sky_cube.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "runtime/scene/mesh/place_hash.h"

namespace gazeloop::scene::sky {
namespace {

constexpr std::uint32_t kFaces = 6;
constexpr std::uint32_t kSamples = 48;

float noise(float x, float y) {
    const float i = std::floor(x);
    const float j = std::floor(y);
    const auto smooth = [](float t) { return t * t * (3.0F - 2.0F * t); };
    const float s = smooth(x - i);
    const float t = smooth(y - j);
    const auto at = [&](int dx, int dy) {
        return static_cast<float>(
            mesh::hashed(static_cast<std::int32_t>(i) + dx, static_cast<std::int32_t>(j) + dy, 0));
    };
    return std::lerp(std::lerp(at(0, 0), at(1, 0), s), std::lerp(at(0, 1), at(1, 1), s), t);
}

float clouds(const glm::vec3& direction) {
    // On a plane overhead; towards the horizon it would run away, so it is bent.
    const float stretch = 2.2F / (direction.y + 0.18F);
    float x = direction.x * stretch + 7.3F;
    float y = direction.z * stretch + 2.9F;
    float sum = 0.0F;
    float weight = 0.5F;
    for (int octave = 0; octave < 5; ++octave) {
        sum += weight * noise(x, y);
        x = 2.03F * x + 1.7F;
        y = 2.03F * y + 9.2F;
        weight *= 0.5F;
    }
    return sum / 0.96875F;
}

float radical_inverse(std::uint32_t n) {
    float value = 0.0F;
    for (float digit = 0.5F; n != 0; n >>= 1U, digit *= 0.5F) {
        value += (n & 1U) != 0 ? digit : 0.0F;
    }
    return value;
}

struct CubePlace {
    std::uint32_t face;
    float s;
    float t;
};

CubePlace cube_place(const glm::vec3& d) {
    const glm::vec3 a = glm::abs(d);
    if (a.x >= a.y && a.x >= a.z) {
        return {d.x > 0.0F ? 0U : 1U, 0.5F + 0.5F * (d.x > 0.0F ? -d.z : d.z) / a.x,
                0.5F - 0.5F * d.y / a.x};
    }
    if (a.y >= a.z) {
        return {d.y > 0.0F ? 2U : 3U, 0.5F + 0.5F * d.x / a.y,
                0.5F + 0.5F * (d.y > 0.0F ? d.z : -d.z) / a.y};
    }
    return {d.z > 0.0F ? 4U : 5U, 0.5F + 0.5F * (d.z > 0.0F ? d.x : -d.x) / a.z,
            0.5F - 0.5F * d.y / a.z};
}

/// The cube's first level, halved again and again: what wide lobes read, so that few samples do.
struct Pyramid {
    explicit Pyramid(const std::vector<glm::vec3>& first) {
        levels.push_back(first);
        for (std::uint32_t face = SkyCube::kFace / 2; face >= 4; face /= 2) {
            const std::vector<glm::vec3>& fine = levels.back();
            std::vector<glm::vec3> coarse(std::size_t{kFaces} * face * face);
            const std::size_t below = std::size_t{2} * face;  // a row of the finer level
            for (std::uint32_t row = 0; row < kFaces * face; ++row) {
                for (std::uint32_t column = 0; column < face; ++column) {
                    const std::size_t at = std::size_t{4} * row * face + std::size_t{2} * column;
                    coarse[std::size_t{row} * face + column] =
                        0.25F * (fine[at] + fine[at + 1] + fine[at + below] + fine[at + below + 1]);
                }
            }
            levels.push_back(std::move(coarse));
        }
    }

    [[nodiscard]] glm::vec3 at(const glm::vec3& direction, float level) const {
        const auto l = static_cast<std::size_t>(
            std::clamp(level + 0.5F, 0.0F, static_cast<float>(levels.size()) - 1.0F));
        const std::uint32_t face = SkyCube::kFace >> l;
        const CubePlace place = cube_place(direction);
        const auto index = [face](float share) {
            return std::min(static_cast<std::uint32_t>(share * static_cast<float>(face)), face - 1);
        };
        return levels[l][(std::size_t{place.face} * face + index(place.t)) * face + index(place.s)];
    }

    std::vector<std::vector<glm::vec3>> levels;
};

/// A sample of the lobe around +Z: direction, the weight of what comes from there, and the level
/// of the pyramid whose texels are about as large as its share of the lobe.
struct LobeSample {
    glm::vec3 direction;
    float weight;
    float level;
};

std::vector<LobeSample> lobe_of(float roughness) {
    std::vector<LobeSample> lobe;
    const float alpha = roughness * roughness;
    for (std::uint32_t i = 0; i < kSamples; ++i) {
        const float share = (static_cast<float>(i) + 0.5F) / kSamples;
        const float around = 2.0F * std::numbers::pi_v<float> * radical_inverse(i);
        const float cos2 = (1.0F - share) / (1.0F + (alpha * alpha - 1.0F) * share);
        const float cosine = std::sqrt(cos2);
        const float sine = std::sqrt(std::max(0.0F, 1.0F - cos2));
        const glm::vec3 half(sine * std::cos(around), sine * std::sin(around), cosine);
        const glm::vec3 light = 2.0F * cosine * half - glm::vec3(0.0F, 0.0F, 1.0F);
        if (light.z <= 0.0F) {
            continue;
        }
        const float bent = cos2 * (alpha * alpha - 1.0F) + 1.0F;
        const float density =
            alpha * alpha / (std::numbers::pi_v<float> * bent * bent) / 4.0F;  // n.h / v.h = 1
        const float solid_angle = 1.0F / (kSamples * std::max(density, 1e-6F));
        const float texel =
            4.0F * std::numbers::pi_v<float> / (6.0F * SkyCube::kFace * SkyCube::kFace);
        lobe.push_back({light, light.z, 0.5F * std::log2(solid_angle / texel) + 0.5F});
    }
    return lobe;
}

std::vector<glm::vec3> blurred(const Pyramid& pyramid, std::uint32_t level) {
    const auto lobe = lobe_of(static_cast<float>(level) / static_cast<float>(SkyCube::kLevels - 1));
    const std::uint32_t face_texels = SkyCube::face_of(level);
    std::vector<glm::vec3> texels;
    texels.reserve(std::size_t{kFaces} * face_texels * face_texels);
    for (std::uint32_t face = 0; face < kFaces; ++face) {
        for (std::uint32_t y = 0; y < face_texels; ++y) {
            for (std::uint32_t x = 0; x < face_texels; ++x) {
                const auto size = static_cast<float>(face_texels);
                const glm::vec3 n =
                    glm::normalize(cube_direction(face, (static_cast<float>(x) + 0.5F) / size,
                                                  (static_cast<float>(y) + 0.5F) / size));
                const glm::vec3 aside = std::abs(n.y) < 0.9F ? glm::vec3(0.0F, 1.0F, 0.0F)
                                                             : glm::vec3(1.0F, 0.0F, 0.0F);
                const glm::vec3 u = glm::normalize(glm::cross(aside, n));
                const glm::vec3 v = glm::cross(n, u);
                glm::vec3 sum(0.0F);
                float weights = 0.0F;
                for (const LobeSample& sample : lobe) {
                    const glm::vec3 d =
                        sample.direction.x * u + sample.direction.y * v + sample.direction.z * n;
                    sum += sample.weight * pyramid.at(d, sample.level);
                    weights += sample.weight;
                }
                texels.push_back(sum / weights);
            }
        }
    }
    return texels;
}

/// Real spherical harmonics of order 0 to 2 at a unit direction.
std::array<float, 9> harmonics(const glm::vec3& d) {
    return {0.282095F,
            0.488603F * d.y,
            0.488603F * d.z,
            0.488603F * d.x,
            1.092548F * d.x * d.y,
            1.092548F * d.y * d.z,
            0.315392F * (3.0F * d.z * d.z - 1.0F),
            1.092548F * d.x * d.z,
            0.546274F * (d.x * d.x - d.y * d.y)};
}

/// From one small level: order 2 needs no more.
std::array<glm::vec3, 9> diffuse_of(const std::vector<glm::vec3>& texels,
                                    std::uint32_t face_texels) {
    constexpr std::array kLobe{1.0F,  2.0F / 3.0F, 2.0F / 3.0F, 2.0F / 3.0F, 0.25F,
                               0.25F, 0.25F,       0.25F,       0.25F};  // A_l / pi
    std::array<glm::vec3, 9> sums{};
    double solid_angles = 0.0;
    std::size_t texel = 0;
    for (std::uint32_t face = 0; face < kFaces; ++face) {
        for (std::uint32_t y = 0; y < face_texels; ++y) {
            for (std::uint32_t x = 0; x < face_texels; ++x, ++texel) {
                const auto size = static_cast<float>(face_texels);
                const glm::vec3 d = cube_direction(face, (static_cast<float>(x) + 0.5F) / size,
                                                   (static_cast<float>(y) + 0.5F) / size);
                const float length = glm::length(d);
                const float solid_angle = 1.0F / (length * length * length);
                const auto basis = harmonics(d / length);
                for (std::size_t i = 0; i < basis.size(); ++i) {
                    sums.at(i) += texels[texel] * (basis.at(i) * solid_angle);
                }
                solid_angles += static_cast<double>(solid_angle);
            }
        }
    }
    const auto scale = static_cast<float>(4.0 * std::numbers::pi / solid_angles);
    for (std::size_t i = 0; i < sums.size(); ++i) {
        sums.at(i) *= scale * kLobe.at(i);
    }
    return sums;
}

}  // namespace

glm::vec3 radiance(const mesh::Sky& sky, const glm::vec3& direction) {
    const float up = direction.y;
    if (up < 0.0F) {
        const float haze = std::exp(12.0F * up);
        return glm::mix(sky.ground, sky.horizon, haze);
    }
    const glm::vec3 clear = glm::mix(sky.horizon, sky.zenith, std::pow(std::min(up, 1.0F), 0.45F));
    if (sky.clouds <= 0.0F) {
        return clear;
    }
    const float cover = clouds(direction);
    const float edge = 0.78F - 0.5F * sky.clouds;
    const float thick = std::clamp((cover - edge) * 5.0F, 0.0F, 1.0F);
    const glm::vec3 white = glm::mix(glm::vec3(1.15F, 1.12F, 1.08F), glm::vec3(0.62F, 0.66F, 0.72F),
                                     std::clamp((cover - edge) * 2.5F, 0.0F, 1.0F));
    const float fade = std::clamp(up * 5.0F, 0.0F, 1.0F);
    return glm::mix(clear, white, 0.9F * thick * fade);
}

glm::vec3 cube_direction(std::uint32_t face, float s, float t) {
    const float a = 2.0F * s - 1.0F;
    const float b = 2.0F * t - 1.0F;
    switch (face) {
        case 0:
            return {1.0F, -b, -a};
        case 1:
            return {-1.0F, -b, a};
        case 2:
            return {a, 1.0F, b};
        case 3:
            return {a, -1.0F, -b};
        case 4:
            return {a, -b, 1.0F};
        default:
            return {-a, -b, -1.0F};
    }
}

SkyCube bake(const mesh::Sky& sky) {
    SkyCube cube;
    std::vector<glm::vec3>& sharp = cube.levels[0];
    sharp.reserve(std::size_t{kFaces} * SkyCube::kFace * SkyCube::kFace);
    for (std::uint32_t face = 0; face < kFaces; ++face) {
        for (std::uint32_t y = 0; y < SkyCube::kFace; ++y) {
            for (std::uint32_t x = 0; x < SkyCube::kFace; ++x) {
                const float s = (static_cast<float>(x) + 0.5F) / SkyCube::kFace;
                const float t = (static_cast<float>(y) + 0.5F) / SkyCube::kFace;
                sharp.push_back(radiance(sky, glm::normalize(cube_direction(face, s, t))));
            }
        }
    }
    const Pyramid pyramid(sharp);
    for (std::uint32_t level = 1; level < SkyCube::kLevels; ++level) {
        cube.levels.at(level) = blurred(pyramid, level);
    }
    constexpr std::uint32_t kSmall = 3;
    cube.diffuse = diffuse_of(pyramid.levels.at(kSmall), SkyCube::kFace >> kSmall);
    return cube;
}

glm::vec3 diffuse_at(const std::array<glm::vec3, 9>& coefficients, const glm::vec3& normal) {
    const auto basis = harmonics(normal);
    glm::vec3 sum(0.0F);
    for (std::size_t i = 0; i < basis.size(); ++i) {
        sum += coefficients.at(i) * basis.at(i);
    }
    return sum;
}

}  // namespace gazeloop::scene::sky
