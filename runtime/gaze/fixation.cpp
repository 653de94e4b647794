#include "runtime/gaze/fixation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "runtime/gaze/direction.h"

namespace gazeloop::gaze {
namespace {

constexpr double kGreatestNearness = 1.0 / kNearestLook_m;
constexpr double kContentNearness = 1.0 / kNearestContent_m;

/// A position in a patch, in samples; whole numbers are samples.
struct At {
    double column;
    double row;
};

/// How many samples apart, on the axis where it is more.
double apart(const At& a, const At& b) {
    return std::max(std::abs(a.column - b.column), std::abs(a.row - b.row));
}

/// What one eye sees on the gaze, 1/m.
struct Found {
    std::optional<double> hit;
    double unseen = 0.0;  ///< the nearest point before the hit that may hold something; 0: none
};

/// What one eye sees within the tracker's accuracy of the gaze, 1/m.
struct Around {
    double nearest = 0.0;
    double farthest = std::numeric_limits<double>::infinity();
    bool all_rows = false;    ///< of the picture are in the patch
    bool to_the_end = false;  ///< so is where the gaze is infinitely far
};

/// A gaze as it appears in one eye's picture. A point of the gaze is given by its nearness n to the
/// gaze's origin, in homogeneous form: the eye sees it in the direction towards_ + n * aside_m_.
class LineOfSight {
  public:
    LineOfSight(const CombinedGaze& gaze_in_world, const DepthPatch& patch) : patch_(patch) {
        const glm::dquat to_view = glm::conjugate(patch.view.pose.orientation);
        towards_ = to_view * gaze_in_world.direction;
        aside_m_ = to_view * (gaze_in_world.origin_m - patch.view.pose.position_m);
        const FieldOfView& fov = patch.view.fov;
        left_ = std::tan(fov.left_rad);
        up_ = std::tan(fov.up_rad);
        px_per_x_ = patch.view.width_px / (std::tan(fov.right_rad) - left_);
        px_per_y_ = patch.view.height_px / (std::tan(fov.down_rad) - up_);
        // NOLINTBEGIN(cppcoreguidelines-prefer-member-initializer): of what was worked out above
        first_x_ = (patch.x0_px + 0.5) / px_per_x_ + left_;
        first_y_ = (patch.y0_px + 0.5) / px_per_y_ + up_;
        x_per_column_ = patch.step_x_px / px_per_x_;
        y_per_row_ = patch.step_y_px / px_per_y_;
        aside_ahead_m_ = glm::dot(towards_, aside_m_);
        // NOLINTEND(cppcoreguidelines-prefer-member-initializer)
    }

    [[nodiscard]] Found follow() const {
        Found found;
        const int steps = step_count();
        double least_apart = kOnTheLine;
        for (int i = steps; i >= 0; --i) {
            const double n = kGreatestNearness * i / std::max(steps, 1);
            const auto here = at(n);
            const auto surface = here ? nearness_along(*here) : std::nullopt;
            const auto there = surface ? at(*surface) : std::nullopt;
            const double miss = there ? apart(*there, *here) : kOnTheLine;
            if (miss < least_apart) {
                least_apart = miss;
                found.hit = surface;
            } else if (found.hit) {
                break;
            } else if (n <= kContentNearness && (!surface || *surface > n)) {
                found.unseen = std::max(found.unseen, n);
            }
        }
        return found;
    }

    /// Samples a quarter of the accuracy apart are enough.
    [[nodiscard]] Around look_around() const {
        Around around;
        const auto far = at(0.0);
        if (!far) {
            return around;
        }
        // A tangent grows by 1 + tangent^2 for an angle, and less on the other axis.
        const double x = towards_.x / towards_.z;
        const double y = towards_.y / towards_.z;
        const double reach = kTrackerAccuracy_rad * (1.0 + x * x + y * y);
        const double columns = reach / x_per_column_;
        const double rows = reach / -y_per_row_;
        const auto near = at(kContentNearness).value_or(*far);
        const Side down{std::min(far->row, near.row) - rows,
                        std::max(far->row, near.row) + rows,
                        patch_.y0_px,
                        patch_.step_y_px,
                        patch_.rows,
                        patch_.view.height_px};
        const Side across{far->column - columns, far->column + columns, patch_.x0_px,
                          patch_.step_x_px,      patch_.columns,        patch_.view.width_px};
        around.all_rows = down.complete();
        around.to_the_end = around.all_rows && across.complete();
        const auto every = [](double samples) {
            return static_cast<std::size_t>(std::clamp(samples / 4.0, 1.0, 1e6));
        };
        for (std::size_t row = down.begin(); row < down.end(); row += every(rows)) {
            const double at_y = tangent_y(static_cast<double>(row));
            for (std::size_t column = 0; column < patch_.columns; column += every(columns)) {
                const double at_x = tangent_x(static_cast<double>(column));
                const Surface surface = surface_at(sample(column, row), at_x, at_y);
                // Where the picture has the gaze's point at the surface's distance, times a depth.
                // There are some thousand samples per frame: one elsewhere must cost no division.
                const glm::dvec3 there = surface.ahead * towards_ + surface.near * aside_m_;
                const double tolerance = reach * -there.z;
                if (std::abs(there.x + at_x * there.z) <= tolerance &&
                    std::abs(there.y + at_y * there.z) <= tolerance && surface.ahead > 0.0) {
                    const double nearness = surface.near / surface.ahead;
                    around.nearest = std::max(around.nearest, nearness);
                    around.farthest = std::min(around.farthest, nearness);
                }
            }
        }
        return around;
    }

  private:
    /// The line is walked in steps of one sample. So what it crosses is met within half a sample,
    /// or within one where the surface slopes as steeply as the line.
    static constexpr double kOnTheLine = 1.0;
    /// More samples than a patch has across, many times over.
    static constexpr double kMostSteps = 1024.0;

    [[nodiscard]] std::optional<At> at(double n) const {
        const glm::dvec3 seen = towards_ + n * aside_m_;
        if (!(seen.z < 0.0)) {
            return std::nullopt;
        }
        const At position{
            ((seen.x / -seen.z - left_) * px_per_x_ - 0.5 - patch_.x0_px) / patch_.step_x_px,
            ((seen.y / -seen.z - up_) * px_per_y_ - 0.5 - patch_.y0_px) / patch_.step_y_px};
        return std::isfinite(position.column) && std::isfinite(position.row)
                   ? std::optional(position)
                   : std::nullopt;
    }

    [[nodiscard]] int step_count() const {
        const auto far = at(0.0);
        const auto near = at(kGreatestNearness);
        return far && near
                   ? static_cast<int>(std::ceil(std::clamp(apart(*far, *near), 0.0, kMostSteps)))
                   : static_cast<int>(kMostSteps);
    }

    [[nodiscard]] double tangent_x(double column) const {
        return first_x_ + column * x_per_column_;
    }
    [[nodiscard]] double tangent_y(double row) const { return first_y_ + row * y_per_row_; }

    /// A surface's nearness to the gaze's origin, measured along the gaze: near / ahead. `ahead` is
    /// not over 0 where the surface is behind the origin or nothing is known of it.
    struct Surface {
        double near;
        double ahead;
    };

    /// What the eye sees by a half float in the direction (x, y, -1).
    [[nodiscard]] Surface surface_at(std::uint16_t half, double x, double y) const {
        if (!is_known(half)) {
            return {0.0, 0.0};
        }
        const double near = value(half) * std::sqrt(x * x + y * y + 1.0);
        return {near, towards_.x * x + towards_.y * y - towards_.z - near * aside_ahead_m_};
    }

    [[nodiscard]] std::optional<double> nearness_along(const At& place) const {
        const At nearest{std::round(place.column), std::round(place.row)};
        if (!(nearest.column >= 0.0 && nearest.column < patch_.columns && nearest.row >= 0.0 &&
              nearest.row < patch_.rows)) {
            return std::nullopt;
        }
        const Surface surface = surface_at(
            sample(static_cast<std::size_t>(nearest.column), static_cast<std::size_t>(nearest.row)),
            tangent_x(nearest.column), tangent_y(nearest.row));
        return surface.ahead > 0.0 ? std::optional(surface.near / surface.ahead) : std::nullopt;
    }

    [[nodiscard]] std::uint16_t sample(std::size_t column, std::size_t row) const {
        return patch_.nearness[row * patch_.columns + column];
    }

    /// Neither negative nor infinitely near nor no number.
    static bool is_known(std::uint16_t half) {
        constexpr std::uint16_t kInfinite = 0x7C00;
        return half < kInfinite;
    }

    /// The value of a half float that is known. Exponent and mantissa are as in a float, except
    /// that the exponent's bias is 15, not 127. Below 2^-14 it counts in steps of 2^-24.
    static double value(std::uint16_t half) {
        constexpr std::uint16_t kLeastNormal = 0x0400;
        return half < kLeastNormal ? half * 0x1p-24
                                   : std::bit_cast<float>(std::uint32_t{half} << 13U) * 0x1p112;
    }

    /// An interval of one axis of the patch, in samples.
    struct Side {
        double from;
        double to;
        std::uint32_t first_px;
        std::uint32_t step_px;
        std::uint32_t samples;
        std::uint32_t picture_px;

        [[nodiscard]] std::size_t within(double place) const {
            return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(samples)));
        }
        [[nodiscard]] std::size_t begin() const { return within(std::ceil(from)); }
        [[nodiscard]] std::size_t end() const { return within(std::floor(to) + 1.0); }
        /// Whether the patch has all that the picture has of it.
        [[nodiscard]] bool complete() const {
            const std::uint64_t end_px = first_px + std::uint64_t{samples} * step_px;
            return (from >= 0.0 || first_px < step_px) &&
                   (to <= samples - 1.0 || end_px >= picture_px);
        }
    };

    const DepthPatch& patch_;
    glm::dvec3 towards_{};
    glm::dvec3 aside_m_{};
    double left_ = 0.0;
    double up_ = 0.0;
    double px_per_x_ = 0.0;
    double px_per_y_ = 0.0;  ///< negative: rows count down
    double first_x_ = 0.0;   ///< tangents of the direction of the patch's first sample
    double first_y_ = 0.0;
    double x_per_column_ = 0.0;
    double y_per_row_ = 0.0;
    double aside_ahead_m_ = 0.0;  ///< how far the gaze's origin is aside, along the gaze
};

double distance_m(double nearness) {
    return nearness > 0.0 ? 1.0 / nearness : std::numeric_limits<double>::infinity();
}

}  // namespace

std::optional<Fixation> find_fixation(const CombinedGaze& gaze_in_world, const SeenDepth& seen) {
    const auto direction = unit(gaze_in_world.direction);
    if (!direction || !is_finite(gaze_in_world.origin_m)) {
        return std::nullopt;
    }
    const CombinedGaze gaze{gaze_in_world.origin_m, *direction};
    std::optional<double> hit;
    double unseen = kContentNearness;
    Around around;
    for (const DepthPatch& patch : seen) {
        if (patch.nearness.empty()) {
            continue;
        }
        const LineOfSight line(gaze, patch);
        const Found found = line.follow();
        unseen = std::min(unseen, found.unseen);
        hit = found.hit ? std::max(hit.value_or(0.0), *found.hit) : hit;
        const Around one = line.look_around();
        around.nearest = std::max(around.nearest, one.nearest);
        around.farthest = std::min(around.farthest, one.farthest);
        around.all_rows = around.all_rows || one.all_rows;
        around.to_the_end = around.to_the_end || one.to_the_end;
    }
    if (!hit) {
        return std::nullopt;
    }
    const double nearest =
        std::max({around.nearest, *hit, around.all_rows ? unseen : kContentNearness});
    const double farthest = around.to_the_end ? std::min(around.farthest, *hit) : 0.0;
    return Fixation{*hit, {distance_m(nearest), distance_m(farthest)}};
}

}  // namespace gazeloop::gaze
