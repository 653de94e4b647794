#include "runtime/foveation/picture/hidden_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace gazeloop::foveation {
namespace {

constexpr double kReachPx = 1.0;         ///< of a bilinear read
constexpr double kBorderPx = 1.0 / 64;   ///< of the picture, not asked about
constexpr double kSlackPx = 1.0 / 256;   ///< more than rounding moves an edge
constexpr double kFarthestPx = 1048576;  ///< up to here rounding stays below 1e-9 px

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

struct PixelTriangle {
    std::array<glm::dvec2, 3> corners;  ///< against the clock in x right, y up; area above 0

    [[nodiscard]] bool contains(const glm::dvec2& point) const {
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec2& a = corners[i];
            if (cross(corners[(i + 1) % 3] - a, point - a) < 0.0) {
                return false;
            }
        }
        return true;
    }
};

/// An edge with the triangle on its left.
using Edge = std::pair<std::array<double, 2>, std::array<double, 2>>;

Edge edge_between(const glm::dvec2& a, const glm::dvec2& b) { return {{a.x, a.y}, {b.x, b.y}}; }

std::vector<PixelTriangle> pixel_triangles(const gaze::HiddenMesh& mesh,
                                           const gaze::EyeView& view) {
    const double left = std::tan(view.fov.left_rad);
    const double up = std::tan(view.fov.up_rad);
    const double across = view.width_px / (std::tan(view.fov.right_rad) - left);
    const double down = view.height_px / (std::tan(view.fov.down_rad) - up);
    std::vector<PixelTriangle> triangles;
    triangles.reserve(mesh.size());
    for (const gaze::HiddenTriangle& hidden : mesh) {
        PixelTriangle triangle{};
        bool usable = true;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec2 at{(hidden.corners[i].x - left) * across,
                                (hidden.corners[i].y - up) * down};
            usable = usable && std::abs(at.x) <= kFarthestPx && std::abs(at.y) <= kFarthestPx;
            triangle.corners[i] = at;
        }
        auto& [a, b, c] = triangle.corners;
        const double area = cross(b - a, c - a);
        if (usable && area != 0.0) {
            if (area < 0.0) {
                std::swap(b, c);
            }
            triangles.push_back(triangle);
        }
    }
    return triangles;
}

/// The edges that may bound the union of the triangles: all but those that two triangles share, one
/// on either side. Wherever the union ends, one of these edges runs.
std::vector<Edge> outer_edges(const std::vector<PixelTriangle>& triangles) {
    std::map<Edge, int> counts;
    for (const PixelTriangle& triangle : triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec2& a = triangle.corners[i];
            const glm::dvec2& b = triangle.corners[(i + 1) % 3];
            const auto opposite = counts.find(edge_between(b, a));
            if (opposite != counts.end() && opposite->second > 0) {
                --opposite->second;
            } else {
                ++counts[edge_between(a, b)];
            }
        }
    }
    std::vector<Edge> edges;
    for (const auto& [edge, count] : counts) {
        if (count > 0) {
            edges.push_back(edge);
        }
    }
    return edges;
}

/// One row of pixels. What no outer edge crosses is wholly inside the mesh or wholly outside.
struct Row {
    bool first_inside = false;  ///< the centre of its first pixel lies in a triangle
    bool last_inside = false;
    int first_crossed =
        std::numeric_limits<int>::max();  ///< the pixels whose surroundings an edge crosses
    int last_crossed = -1;

    [[nodiscard]] Columns visible(std::uint32_t width) const {
        const bool crossed = last_crossed >= 0;
        if (first_inside && !crossed) {
            return {};
        }
        return {first_inside ? static_cast<std::uint32_t>(first_crossed) : 0,
                last_inside && crossed ? static_cast<std::uint32_t>(last_crossed) + 1 : width};
    }
};

/// The rows with centres whose surroundings reach into [low, high], clipped to the picture.
std::pair<int, int> rows_near(double low, double high, std::uint32_t height) {
    return {static_cast<int>(std::max(0.0, std::floor(low - 0.5 - kReachPx))),
            static_cast<int>(std::min(height - 1.0, std::ceil(high - 0.5 + kReachPx)))};
}

void mark_inside(const PixelTriangle& triangle, ImageSize image, std::vector<Row>& rows) {
    const auto [low, high] =
        std::minmax({triangle.corners[0].y, triangle.corners[1].y, triangle.corners[2].y});
    const auto [first, last] = rows_near(low, high, image.height_px);
    for (int y = first; y <= last; ++y) {
        Row& row = rows[static_cast<std::size_t>(y)];
        const double centre = y + 0.5;
        row.first_inside = row.first_inside || triangle.contains({0.5, centre});
        row.last_inside = row.last_inside || triangle.contains({image.width_px - 0.5, centre});
    }
}

void mark_crossed(const Edge& edge, ImageSize image, std::vector<Row>& rows) {
    const bool falls = edge.first[1] > edge.second[1];
    const auto& [x0, y0] = falls ? edge.second : edge.first;
    const auto& [x1, y1] = falls ? edge.first : edge.second;
    const double least = kBorderPx;
    const double greatest_x = image.width_px - kBorderPx;
    const double greatest_y = image.height_px - kBorderPx;
    const auto [first, last] = rows_near(y0 - kSlackPx, y1 + kSlackPx, image.height_px);
    for (int y = first; y <= last; ++y) {
        const double centre = y + 0.5;
        const double low = std::max(centre - kReachPx, least) - kSlackPx;
        const double high = std::min(centre + kReachPx, greatest_y) + kSlackPx;
        if (y1 <= low || y0 >= high) {
            continue;
        }
        const double rise = y1 - y0;
        const auto x_at = [&](double at) {
            return rise > 0.0 ? x0 + (x1 - x0) * std::clamp((at - y0) / rise, 0.0, 1.0) : x0;
        };
        const double a = rise > 0.0 ? x_at(low) : x0;
        const double b = rise > 0.0 ? x_at(high) : x1;
        const double left = std::min(a, b) - kSlackPx;
        const double right = std::max(a, b) + kSlackPx;
        if (right <= least || left >= greatest_x) {
            continue;
        }
        // Pixel x reaches over (x + .5 - kReachPx, x + .5 + kReachPx).
        Row& row = rows[static_cast<std::size_t>(y)];
        const double from = std::floor(left - 0.5 - kReachPx) + 1.0;
        const double to = std::ceil(right - 0.5 + kReachPx) - 1.0;
        const double last_pixel = image.width_px - 1.0;
        row.first_crossed =
            std::min(row.first_crossed, static_cast<int>(std::clamp(from, 0.0, last_pixel)));
        row.last_crossed =
            std::max(row.last_crossed, static_cast<int>(std::clamp(to, 0.0, last_pixel)));
    }
}

/// Andrew's monotone chain.
std::vector<glm::dvec2> convex_hull(std::vector<glm::dvec2> points) {
    std::ranges::sort(points, [](const glm::dvec2& a, const glm::dvec2& b) {
        return std::pair(a.x, a.y) < std::pair(b.x, b.y);
    });
    std::vector<glm::dvec2> hull;
    const auto add = [&hull](const glm::dvec2& point, std::size_t keep) {
        while (hull.size() >= keep + 2 &&
               cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0.0) {
            hull.pop_back();
        }
        hull.push_back(point);
    };
    for (const glm::dvec2& point : points) {
        add(point, 0);
    }
    const std::size_t lower = hull.size() - 1;
    for (std::size_t i = points.size() - 1; i-- > 0;) {
        add(points[i], lower);
    }
    hull.pop_back();  // the first one again
    return hull;
}

}  // namespace

HiddenArea::HiddenArea(const gaze::HiddenMesh& mesh, const gaze::EyeView& view) {
    const ImageSize image{view.width_px, view.height_px};
    const std::vector<PixelTriangle> triangles = pixel_triangles(mesh, view);
    std::vector<Row> rows(image.height_px);
    for (const PixelTriangle& triangle : triangles) {
        mark_inside(triangle, image, rows);
    }
    for (const Edge& edge : outer_edges(triangles)) {
        mark_crossed(edge, image, rows);
    }

    for (std::uint32_t y0 = 0; y0 < image.height_px; y0 += kGroupRows) {
        const std::uint32_t y1 = std::min(y0 + kGroupRows, image.height_px);
        Columns group{image.width_px, 0};
        for (std::uint32_t y = y0; y < y1; ++y) {
            const Columns visible = rows[y].visible(image.width_px);
            if (!visible.empty()) {
                group = {std::min(group.first, visible.first), std::max(group.end, visible.end)};
            }
        }
        groups_.push_back(group);
    }
    fill_columns();

    std::vector<glm::dvec2> corners;
    hidden_pixels_ = std::uint64_t{image.width_px} * image.height_px;
    for (std::uint32_t y0 = 0; y0 < image.height_px; y0 += kGroupRows) {
        const std::uint32_t y1 = std::min(y0 + kGroupRows, image.height_px);
        Columns& group = groups_[y0 / kGroupRows];
        if (group.empty()) {
            group = {};
        } else {
            group = {group.first / kBlockColumns * kBlockColumns,
                     std::min((group.end + kBlockColumns - 1) / kBlockColumns * kBlockColumns,
                              image.width_px)};
            add_tile({group.first, y0, group.end, y1});
            hidden_pixels_ -= std::uint64_t{y1 - y0} * (group.end - group.first);
            for (const double x : {group.first + 0.5, group.end - 0.5}) {
                corners.emplace_back(x, y0 + 0.5);
                corners.emplace_back(x, y1 - 0.5);
            }
        }
    }
    if (!corners.empty()) {
        outline_ = convex_hull(std::move(corners));
    }
}

/// What is visible both above and below a group is visible in it.
void HiddenArea::fill_columns() {
    std::vector<Columns> below(groups_.size(), Columns{UINT32_MAX, 0});
    const auto joined = [](const Columns& a, const Columns& b) {
        return Columns{std::min(a.first, b.first), std::max(a.end, b.end)};
    };
    for (std::size_t i = groups_.size() - 1; i-- > 0;) {
        below[i] = joined(below[i + 1], groups_[i + 1]);
    }
    Columns above{UINT32_MAX, 0};
    for (std::size_t i = 0; i < groups_.size(); ++i) {
        const Columns between{std::max(above.first, below[i].first),
                              std::min(above.end, below[i].end)};
        above = joined(above, groups_[i]);
        if (!between.empty()) {
            groups_[i] = joined(groups_[i], between);
        }
    }
}

void HiddenArea::add_tile(const Tile& tile) {
    Tile* const above = tiles_.empty() ? nullptr : &tiles_.back();
    if (above != nullptr && above->y1 == tile.y0 && above->x0 == tile.x0 && above->x1 == tile.x1) {
        above->y1 = tile.y1;
    } else {
        tiles_.push_back(tile);
    }
}

HiddenAreas hidden_areas(const gaze::HiddenMeshes& meshes, const gaze::StereoView& views) {
    HiddenAreas areas;
    if (meshes == nullptr) {
        return areas;
    }
    for (const gaze::Eye eye : gaze::kEyes) {
        const std::size_t e = gaze::index(eye);
        auto area = std::make_shared<const HiddenArea>((*meshes)[e], views[e]);
        if (area->hidden_pixels() > 0 && !area->visible_tiles().empty()) {
            areas[e] = std::move(area);
        }
    }
    return areas;
}

}  // namespace gazeloop::foveation
