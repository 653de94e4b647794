#include "runtime/report/fovea_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numbers>

#include "runtime/gaze/head_limits.h"
#include "runtime/latency/duration_histogram.h"
#include "runtime/session/cursor.h"

namespace gazeloop::report {
namespace {

constexpr double kSameView_rad = 0.01 * std::numbers::pi / 180.0;
/// The histogram counts in nanoseconds; a nanodegree is as fine.
constexpr double kNanodegrees = 1e9;
constexpr double kNsPerMs = 1e6;

bool same_view(const gaze::EyeView& a, const gaze::EyeView& b) {
    return a.fov == b.fov && gaze::turned_rad(a.pose, b.pose) < kSameView_rad;
}

bool with_gaze(const frame::FrameRecord& frame) {
    return std::ranges::all_of(frame.fovea.eyes, [](const gaze::FoveaPoint& point) {
        return point.state <= gaze::FoveaState::OtherEye;
    });
}

/// By both products, because acos is inexact at small angles. NaN for a direction that is none.
double angle_rad(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

class PathDifference {
  public:
    void add(const frame::FrameRecord& before, const frame::FrameRecord& after) {
        if (!before.should_render || !after.should_render) {
            result_.only_in_one += before.should_render == after.should_render ? 0 : 1;
            return;
        }
        double greatest = 0.0;
        for (const gaze::Eye eye : gaze::kEyes) {
            const std::size_t at = gaze::index(eye);
            if (!same_view(before.views[at], after.views[at])) {
                ++result_.other_view;
                return;
            }
            const double angle =
                angle_rad(before.fovea.eyes[at].direction, after.fovea.eyes[at].direction);
            greatest = angle > greatest || std::isnan(angle) ? angle : greatest;
        }
        if (!with_gaze(before) || !with_gaze(after) || !std::isfinite(greatest)) {
            ++result_.without_gaze;
            return;
        }
        ++result_.compared;
        angles_.add(std::llround(glm::degrees(greatest) * kNanodegrees));
    }

    void add_lonely() { ++result_.only_in_one; }

    [[nodiscard]] FoveaPathDifference result() const {
        FoveaPathDifference result = result_;
        const auto degrees = [](const std::optional<double>& ms) {
            return ms ? *ms * kNsPerMs / kNanodegrees : std::numeric_limits<double>::quiet_NaN();
        };
        result.mean_deg = degrees(angles_.mean_ms());
        result.p50_deg = degrees(angles_.percentile_ms(50.0));
        result.p95_deg = degrees(angles_.percentile_ms(95.0));
        result.max_deg = degrees(angles_.max_ms());
        return result;
    }

  private:
    FoveaPathDifference result_;
    latency::DurationHistogram angles_;
};

}  // namespace

std::string FoveaPathDifference::doubt() const {
    const std::uint64_t all = compared + only_in_one + other_view + without_gaze;
    if (all == 0) {
        return "neither session has a rendered frame";
    }
    if (2 * compared >= all) {
        return {};
    }
    if (other_view >= std::max(only_in_one, without_gaze)) {
        return fmt::format(
            "the heads moved differently in {} of {} frames: replay one trace twice to compare",
            other_view, all);
    }
    if (without_gaze >= only_in_one) {
        return fmt::format("one of the two had no fresh gaze in {} of {} frames", without_gaze,
                           all);
    }
    return fmt::format("{} of {} frames are in one of the two alone", only_in_one, all);
}

Expected<FoveaPathDifference> fovea_path_difference(const session::OpenSession& before,
                                                    const session::OpenSession& after) {
    session::FrameCursor first(before);
    session::FrameCursor second(after);
    PathDifference difference;
    for (session::FrameCursor* const cursor : {&first, &second}) {
        if (auto moved = cursor->next(); !moved) {
            return std::unexpected(std::move(moved.error()));
        }
    }
    while (first.row() != nullptr || second.row() != nullptr) {
        const bool of_first =
            second.row() == nullptr ||
            (first.row() != nullptr && first.row()->frame.index <= second.row()->frame.index);
        const bool of_second =
            first.row() == nullptr ||
            (second.row() != nullptr && second.row()->frame.index <= first.row()->frame.index);
        if (of_first && of_second) {
            difference.add(first.row()->frame, second.row()->frame);
        } else if ((of_first ? first : second).row()->frame.should_render) {
            difference.add_lonely();
        }
        for (const auto& [moves, cursor] :
             {std::pair{of_first, &first}, std::pair{of_second, &second}}) {
            if (!moves) {
                continue;
            }
            if (auto moved = cursor->next(); !moved) {
                return std::unexpected(std::move(moved.error()));
            }
        }
    }
    return difference.result();
}

}  // namespace gazeloop::report
