#include "runtime/scene/gallery/gallery_textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "runtime/scene/gallery/seamless_noise.h"
#include "runtime/scene/mesh/place_hash.h"

namespace gazeloop::scene::gallery {
namespace {

/// One place of a pattern. The height's unit is the pattern's width.
struct Place {
    glm::dvec3 color{1.0};  ///< sRGB code / 255
    double height = 0.0;
    double roughness = 1.0;  ///< share of the material's, [0, 1]
    double occlusion = 1.0;
};

/// 1 inside, 0 at the edge of a cell, over `border` shares of it.
double raised(double share, double border) {
    const double from_edge = std::min(share, 1.0 - share);
    const double t = std::clamp(from_edge / border, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

Place plaster(double u, double v) {
    const double grain = seamless_octaves(u, v, 6, 6, 11);
    return {glm::dvec3(0.90, 0.88, 0.84) * (0.93 + 0.1 * grain), 0.012 * grain, 1.0, 1.0};
}

Place stone(double u, double v) {
    const double body = seamless_octaves(u, v, 3, 7, 23);
    const double vein = std::abs(seamless_octaves(u, v, 2, 6, 31) - 0.5);
    const double dark = std::exp(-vein * 45.0);
    const glm::dvec3 color =
        glm::mix(glm::dvec3(0.66, 0.64, 0.62), glm::dvec3(0.84, 0.82, 0.79), body);
    return {glm::mix(color, glm::dvec3(0.42, 0.36, 0.32), 0.7 * dark), 0.03 * body - 0.012 * dark,
            0.7 + 0.3 * body, 1.0 - 0.3 * dark};
}

Place brick(double u, double v) {
    constexpr double kRows = 8.0;
    constexpr double kColumns = 4.0;
    const double row = std::floor(v * kRows);
    const double shifted = u * kColumns + (std::fmod(row, 2.0) == 0.0 ? 0.0 : 0.5);
    const double column = std::floor(shifted);
    const double inside = raised(shifted - column, 0.05) * raised(v * kRows - row, 0.1);
    const double tone =
        mesh::hashed(static_cast<std::int32_t>(column) % static_cast<std::int32_t>(kColumns),
                     static_cast<std::int32_t>(row), 5);
    const double grain = seamless_octaves(u, v, 12, 5, 41);
    const glm::dvec3 clay =
        glm::mix(glm::dvec3(0.52, 0.25, 0.18), glm::dvec3(0.72, 0.42, 0.30), tone) *
        (0.85 + 0.3 * grain);
    const glm::dvec3 mortar = glm::dvec3(0.70, 0.67, 0.62) * (0.85 + 0.2 * grain);
    return {glm::mix(mortar, clay, inside), 0.03 * inside + 0.012 * grain, 1.0,
            0.55 + 0.45 * inside};
}

Place wood(double u, double v) {
    const double bent = v + 0.04 * (seamless_octaves(u, v, 3, 4, 53) - 0.5);
    const double ring = 0.5 + 0.5 * std::sin(2.0 * std::numbers::pi * 9.0 * bent +
                                             3.0 * seamless_octaves(u, v, 2, 3, 59));
    const double fibre = seamless_noise(u, v, 8, 256, 61);
    const glm::dvec3 color =
        glm::mix(glm::dvec3(0.58, 0.36, 0.20), glm::dvec3(0.38, 0.20, 0.10), std::pow(ring, 2.0));
    return {color * (0.9 + 0.2 * fibre), 0.002 * fibre - 0.003 * ring, 0.7 + 0.3 * ring, 1.0};
}

Place tile(double u, double v) {
    constexpr double kTiles = 4.0;
    const double x = u * kTiles;
    const double y = v * kTiles;
    const double inside = raised(x - std::floor(x), 0.06) * raised(y - std::floor(y), 0.06);
    const bool odd = (static_cast<int>(x) + static_cast<int>(y)) % 2 != 0;
    const glm::dvec3 glaze = odd ? glm::dvec3(0.86, 0.87, 0.84) : glm::dvec3(0.10, 0.30, 0.38);
    const double wave = seamless_octaves(u, v, 8, 3, 67);
    return {glm::mix(glm::dvec3(0.55, 0.52, 0.48), glaze, inside), 0.012 * inside + 0.003 * wave,
            inside > 0.5 ? 0.2 + 0.1 * wave : 1.0, 0.6 + 0.4 * inside};
}

Place hammered(double u, double v) {
    // The nearest of scattered dents, on a lattice that repeats.
    constexpr std::int32_t kCells = 10;
    double nearest = 1.0;
    const auto i = static_cast<std::int32_t>(u * kCells);
    const auto j = static_cast<std::int32_t>(v * kCells);
    for (std::int32_t dy = -1; dy <= 1; ++dy) {
        for (std::int32_t dx = -1; dx <= 1; ++dx) {
            const std::int32_t x = (i + dx + kCells) % kCells;
            const std::int32_t y = (j + dy + kCells) % kCells;
            const glm::dvec2 centre(i + dx + 0.2 + 0.6 * mesh::hashed(x, y, 71),
                                    j + dy + 0.2 + 0.6 * mesh::hashed(x, y, 73));
            nearest = std::min(nearest, glm::length(centre - glm::dvec2(u, v) * double{kCells}));
        }
    }
    return {glm::dvec3(1.0), 0.03 * std::min(nearest * nearest, 0.5), 0.7 + 0.3 * nearest, 1.0};
}

Place brushed(double u, double v) {
    const double line = seamless_noise(u, v, 6, 256, 79);
    return {glm::dvec3(0.95 + 0.05 * line), 0.0012 * line, 0.6 + 0.4 * line, 1.0};
}

Place ground(double u, double v) {
    const double large = seamless_octaves(u, v, 4, 6, 83);
    const double fine = seamless_octaves(u, v, 32, 3, 89);
    const double grass = std::clamp((large - 0.42) * 6.0, 0.0, 1.0);
    const glm::dvec3 soil =
        glm::mix(glm::dvec3(0.52, 0.45, 0.36), glm::dvec3(0.68, 0.62, 0.52), fine);
    const glm::dvec3 green =
        glm::mix(glm::dvec3(0.26, 0.33, 0.15), glm::dvec3(0.44, 0.48, 0.25), fine);
    return {glm::mix(soil, green, grass), 0.02 * fine + 0.02 * large, 1.0, 0.75 + 0.25 * fine};
}

Place place_of(Pattern pattern, double u, double v) {
    switch (pattern) {
        case Pattern::Plaster:
            return plaster(u, v);
        case Pattern::Stone:
            return stone(u, v);
        case Pattern::Brick:
            return brick(u, v);
        case Pattern::Wood:
            return wood(u, v);
        case Pattern::Tile:
            return tile(u, v);
        case Pattern::Hammered:
            return hammered(u, v);
        case Pattern::Brushed:
            return brushed(u, v);
        case Pattern::Ground:
            return ground(u, v);
    }
    return {};
}

void put(mesh::Image& image, std::size_t texel, const glm::dvec3& rgb) {
    for (std::size_t c = 0; c < 3; ++c) {
        const double code = std::round(std::clamp(rgb[static_cast<int>(c)], 0.0, 1.0) * 255.0);
        image.texels[4 * texel + c] = static_cast<std::byte>(static_cast<std::uint8_t>(code));
    }
    image.texels[4 * texel + 3] = std::byte{255};
}

mesh::Image blank(std::uint32_t size, mesh::ColorSpace space) {
    mesh::Image image;
    image.name = "gallery";
    image.width = size;
    image.height = size;
    image.color_space = space;
    image.texels.resize(std::size_t{4} * size * size);
    return image;
}

}  // namespace

PatternImages paint(Pattern pattern, std::uint32_t size) {
    PatternImages images{blank(size, mesh::ColorSpace::Srgb), blank(size, mesh::ColorSpace::Linear),
                         blank(size, mesh::ColorSpace::Linear)};
    std::vector<double> heights(std::size_t{size} * size);
    for (std::uint32_t y = 0; y < size; ++y) {
        for (std::uint32_t x = 0; x < size; ++x) {
            const std::size_t texel = std::size_t{y} * size + x;
            const Place place = place_of(pattern, (x + 0.5) / size, (y + 0.5) / size);
            put(images.color, texel, place.color);
            put(images.surface, texel, {place.occlusion, place.roughness, 1.0});
            heights[texel] = place.height;
        }
    }
    const auto height = [&](std::uint32_t x, std::uint32_t y) {
        return heights[std::size_t{y % size} * size + x % size];
    };
    for (std::uint32_t y = 0; y < size; ++y) {
        for (std::uint32_t x = 0; x < size; ++x) {
            const double per_u = (height(x + 1, y) - height(x + size - 1, y)) * size / 2.0;
            const double per_v = (height(x, y + 1) - height(x, y + size - 1)) * size / 2.0;
            // Rows go down, the bitangent up.
            const glm::dvec3 normal = glm::normalize(glm::dvec3(-per_u, per_v, 1.0));
            put(images.normal, std::size_t{y} * size + x, 0.5 * normal + 0.5);
        }
    }
    return images;
}

}  // namespace gazeloop::scene::gallery
