#include "runtime/scene/gallery/parametric_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

namespace gazeloop::scene::gallery {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

glm::dvec3 on_sphere(double u, double v) {
    const double around = kTurn * u;
    const double down = std::numbers::pi * v;
    return {std::sin(down) * std::cos(around), std::cos(down), -std::sin(down) * std::sin(around)};
}

glm::dvec3 ball(double u, double v) { return on_sphere(u, v); }

glm::dvec3 torus(double u, double v) {
    const double tube = 0.72 + 0.28 * std::cos(kTurn * v);
    return {tube * std::cos(kTurn * u), -0.28 * std::sin(kTurn * v), -tube * std::sin(kTurn * u)};
}

/// A tube of this radius around a closed or open curve, at its parameter u.
template <typename Curve>
glm::dvec3 tube(const Curve& curve, double u, double v, double radius) {
    constexpr double kStep = 1e-4;
    const glm::dvec3 here = curve(u);
    const glm::dvec3 ahead = glm::normalize(curve(u + kStep) - curve(u - kStep));
    const glm::dvec3 bend = curve(u + kStep) + curve(u - kStep) - 2.0 * here;
    const glm::dvec3 side = glm::normalize(bend - glm::dot(bend, ahead) * ahead);
    const glm::dvec3 up = glm::cross(ahead, side);
    return here + radius * (std::cos(kTurn * v) * side + std::sin(kTurn * v) * up);
}

glm::dvec3 trefoil(double u, double v) {
    const auto knot = [](double t) {
        const double a = kTurn * t;
        return 0.31 * glm::dvec3(std::sin(a) + 2.0 * std::sin(2.0 * a),
                                 std::cos(a) - 2.0 * std::cos(2.0 * a), -1.1 * std::sin(3.0 * a));
    };
    return tube(knot, u, v, 0.17);
}

/// Sign-keeping power.
double rounded(double x, double power) { return std::copysign(std::pow(std::abs(x), power), x); }

glm::dvec3 cushion(double u, double v) {
    const glm::dvec3 p = on_sphere(u, v);
    const double size = std::pow(
        std::pow(std::abs(p.x), 5.0) + std::pow(std::abs(p.y), 5.0) + std::pow(std::abs(p.z), 5.0),
        -0.2);
    return 0.72 * size * p;
}

glm::dvec3 blossom(double u, double v) {
    const double around = kTurn * u;
    const double down = std::numbers::pi * v;
    const double ripple =
        std::pow(std::sin(down), 3.0) * std::cos(6.0 * around) * std::cos(3.0 * down + 0.6);
    return (0.8 + 0.2 * ripple) * on_sphere(u, v);
}

glm::dvec3 coil(double u, double v) {
    const auto axis = [](double t) {
        const double a = kTurn * t;
        const double wide = 0.55 + 0.22 * std::cos(a);
        return glm::dvec3(wide * std::cos(5.0 * a), 0.72 * std::sin(a), -wide * std::sin(5.0 * a));
    };
    return tube(axis, u, v, 0.1);
}

glm::dvec3 vase(double u, double v) {
    // The outline runs up inside and down outside, so that the vase is closed and has a wall.
    const double outline = -kTurn * v;
    const double height = -std::cos(outline);
    const double belly = 0.46 + 0.2 * std::sin(2.4 * height + 0.5) + 0.05 * height;
    const double wall = std::sin(outline) >= 0.0 ? 1.0 : 0.86;
    const double foot = std::min(1.0, 3.2 * std::sqrt(std::max(0.0, 1.0 + height)));
    const double radius = belly * foot * (0.93 + 0.07 * std::sin(outline)) *
                          (wall + (1.0 - wall) * std::exp(-40.0 * std::abs(std::sin(outline))));
    const double flute = 1.0 + 0.025 * std::cos(14.0 * kTurn * u);
    return {radius * flute * std::cos(kTurn * u), height, -radius * flute * std::sin(kTurn * u)};
}

glm::dvec3 twist(double u, double v) {
    const glm::dvec3 p = on_sphere(u, v);
    const double x = 0.5 * rounded(p.x, 0.35);
    const double y = rounded(p.y, 0.5);
    const double z = 0.5 * rounded(p.z, 0.35);
    const double turn = 1.5 * y;
    return {x * std::cos(turn) - z * std::sin(turn), y, x * std::sin(turn) + z * std::cos(turn)};
}

constexpr std::array kSurfaces{ParametricSurface{"ball", ball, 0.5, {4.0, 2.0}},
                               ParametricSurface{"torus", torus, 0.4, {6.0, 2.0}},
                               ParametricSurface{"trefoil", trefoil, 0.1, {12.0, 1.0}},
                               ParametricSurface{"cushion", cushion, 0.5, {4.0, 2.0}},
                               ParametricSurface{"blossom", blossom, 0.5, {4.0, 2.0}},
                               ParametricSurface{"coil", coil, 0.04, {24.0, 1.0}},
                               ParametricSurface{"vase", vase, 1.0, {4.0, 4.0}},
                               ParametricSurface{"twist", twist, 0.6, {4.0, 2.0}}};

/// A normal that holds at poles too: there the neighbourhood a little inside stands for it.
glm::dvec3 normal_at(const ParametricSurface& surface, double u, double v) {
    constexpr double kStep = 1e-4;
    for (const double inside : {0.0, 2e-3, 1e-2}) {
        const double w = std::clamp(v, inside, 1.0 - inside);
        const glm::dvec3 along_u = surface.at(u + kStep, w) - surface.at(u - kStep, w);
        const glm::dvec3 along_v = surface.at(u, w + kStep) - surface.at(u, w - kStep);
        const glm::dvec3 across = glm::cross(along_v, along_u);  // v runs down
        const double size = glm::length(across);
        if (size > 1e-12) {
            return across / size;
        }
    }
    return {0.0, 1.0, 0.0};
}

glm::dvec3 tangent_at(const ParametricSurface& surface, const glm::dvec3& normal, double u,
                      double v) {
    constexpr double kStep = 1e-4;
    const double w = std::clamp(v, 1e-2, 1.0 - 1e-2);
    const glm::dvec3 along = surface.at(u + kStep, w) - surface.at(u - kStep, w);
    const glm::dvec3 level = along - glm::dot(along, normal) * normal;
    const double size = glm::length(level);
    return size > 1e-12 ? level / size : glm::dvec3(1.0, 0.0, 0.0);
}

void grow(mesh::Bounds& bounds, const glm::vec3& point) {
    bounds.low_m = glm::min(bounds.low_m, point);
    bounds.high_m = glm::max(bounds.high_m, point);
}

/// Numbers vertices in the order in which triangles use them; those that none uses go.
void number_by_use(Tessellation& made) {
    std::vector<std::uint32_t> numbers(made.vertices.size(), mesh::kNone);
    std::vector<mesh::Vertex> used;
    used.reserve(made.vertices.size());
    for (std::uint32_t& index : made.indices) {
        if (numbers[index] == mesh::kNone) {
            numbers[index] = static_cast<std::uint32_t>(used.size());
            used.push_back(made.vertices[index]);
        }
        index = numbers[index];
    }
    made.vertices = std::move(used);
}

}  // namespace

std::span<const ParametricSurface> parametric_surfaces() { return kSurfaces; }

Tessellation tessellate(const ParametricSurface& surface, std::uint32_t triangles) {
    const double cells = std::max(8.0, triangles / 2.0);
    const auto rows =
        static_cast<std::uint32_t>(std::max(3.0, std::floor(std::sqrt(cells * surface.aspect))));
    const auto columns = static_cast<std::uint32_t>(std::max(3.0, std::floor(cells / rows)));
    Tessellation out;
    out.vertices.reserve(std::size_t{rows + 1} * (columns + 1));
    for (std::uint32_t row = 0; row <= rows; ++row) {
        for (std::uint32_t column = 0; column <= columns; ++column) {
            const double u = static_cast<double>(column) / columns;
            const double v = static_cast<double>(row) / rows;
            const glm::dvec3 normal = normal_at(surface, u, v);
            mesh::Vertex vertex;
            vertex.position_m = glm::vec3(surface.at(u, v));
            vertex.normal = glm::vec3(normal);
            vertex.tangent = glm::vec4(glm::vec3(tangent_at(surface, normal, u, v)), 1.0F);
            vertex.uv[0] = glm::vec2(glm::dvec2(u, v) * surface.repeats);
            vertex.uv[1] = vertex.uv[0];
            grow(out.bounds, vertex.position_m);
            out.vertices.push_back(vertex);
        }
    }
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const glm::vec3& p = out.vertices[a].position_m;
        const glm::vec3 across =
            glm::cross(out.vertices[b].position_m - p, out.vertices[c].position_m - p);
        if (glm::dot(across, across) > 1e-14F) {
            out.indices.insert(out.indices.end(), {a, b, c});
        }
    };
    double squares = 0.0;
    const auto measure = [&](double u0, double v0, double u1, double v1) {
        const glm::dvec3 chord = 0.5 * (surface.at(u0, v0) + surface.at(u1, v1));
        const glm::dvec3 apart = surface.at((u0 + u1) / 2.0, (v0 + v1) / 2.0) - chord;
        squares += glm::dot(apart, apart);
    };
    // In strips of a few columns: a vertex is then used again before a vertex cache forgets it.
    constexpr std::uint32_t kStrip = 12;
    for (std::uint32_t strip = 0; strip < columns; strip += kStrip) {
        for (std::uint32_t row = 0; row < rows; ++row) {
            for (std::uint32_t column = strip; column < std::min(strip + kStrip, columns);
                 ++column) {
                const std::uint32_t corner = row * (columns + 1) + column;
                add(corner, corner + columns + 1, corner + 1);
                add(corner + 1, corner + columns + 1, corner + columns + 2);
                const double u = static_cast<double>(column) / columns;
                const double v = static_cast<double>(row) / rows;
                measure(u, v, u + 1.0 / columns, v);
                measure(u, v, u, v + 1.0 / rows);
            }
        }
    }
    number_by_use(out);
    out.error_m = static_cast<float>(2.0 * std::sqrt(squares / (2.0 * rows * columns)));
    return out;
}

}  // namespace gazeloop::scene::gallery
