#include "sim/gaze_path.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numbers>

#include "runtime/gaze/direction.h"
#include "sim/room_for_plans.h"
#include "sim/turned_direction.h"

namespace gazeloop::sim {
namespace {

constexpr double kFixationSpread = 0.6;       // SD of a duration's logarithm
constexpr double kSmallestSaccade_deg = 1.0;  // smaller ones are microsaccades
constexpr double kFarthestTurn_rad = glm::radians(30.0);

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

}  // namespace

GazePath::GazePath(const EyeTerms& terms, const HeadTerms& head_terms, std::uint64_t seed,
                   SimulatedHead& head)
    : terms_(terms), head_terms_(head_terms), seed_(seed), head_(head) {
    Random random(seed_, Stream::Targets);
    Shift first{.saccade = Saccade(target(random, head_.swayed(0.0)))};
    first.to_dioptres = draw_dioptres(0);
    first.from_dioptres = first.to_dioptres;
    plan_stay(first, 0);
    if (terms_.saccade_deg > 0.0) {
        // Fixations have a mean of exp(s^2 / 2) of their median; saccades come on top.
        const double mean_s =
            terms_.fixation_ms * 1e-3 * std::exp(kFixationSpread * kFixationSpread / 2.0);
        shifts_.reserve(room_for_plans(1.0 / mean_s));
        head_.make_room_for_turns(room_for_plans(head_terms_.turn_percent / 100.0 / mean_s));
    }
    shifts_.push_back(first);
}

void GazePath::plan_until(double time_s) {
    while (time_s >= shifts_.back().end_s) {
        add_shift();
    }
}

void GazePath::add_shift() {
    const std::uint64_t event = shifts_.size();
    const Shift& last = shifts_.back();
    const double begin_s = last.end_s;
    const glm::dvec3 from = direction(last, begin_s);
    if (head_terms_.turn_percent > 0.0) {
        turn_head(event, begin_s);
    }
    // Where the head will point when its turns are over.
    const Heading about = head_.swayed(begin_s) + head_.rest();
    Random random(seed_, Stream::Targets, event);
    glm::dvec3 to = target(random, about);
    // Where all targets lie close together, no saccade could be that large.
    const double smallest_deg = std::min(kSmallestSaccade_deg, terms_.saccade_deg / 2.0);
    // So small a field may have no two directions that differ by more than their rounding.
    constexpr int kMostDraws = 1000;
    for (int draw = 0; draw < kMostDraws && angle_deg(from, to) < smallest_deg; ++draw) {
        to = target(random, about);
    }
    const double vigour = terms_.saccade_scatter_percent > 0.0
                              ? Random(seed_, Stream::SaccadeScatter, event)
                                    .log_normal(1.0, terms_.saccade_scatter_percent / 100.0)
                              : 1.0;
    Shift next{.begin_s = begin_s, .saccade = Saccade(from, to, vigour)};
    next.from_dioptres = last.to_dioptres;
    next.to_dioptres = draw_dioptres(event);
    plan_stay(next, event);
    shifts_.push_back(next);
}

void GazePath::turn_head(std::uint64_t event, double begin_s) {
    Random random(seed_, Stream::Turns, event);
    if (random.uniform() * 100.0 >= head_terms_.turn_percent) {
        return;
    }
    const Heading now = head_.turned(begin_s);
    const double turn_rad = glm::radians(head_terms_.turn_deg);
    const auto bounded = [](double drawn, double present) {
        return std::clamp(drawn, present - kFarthestTurn_rad, present + kFarthestTurn_rad);
    };
    const double yaw_rad = bounded(turn_rad * random.normal(), now.yaw_rad);
    const double pitch_rad = bounded(turn_rad / 3.0 * random.normal(), now.pitch_rad);
    head_.turn(begin_s, {yaw_rad - head_.rest().yaw_rad, pitch_rad - head_.rest().pitch_rad});
}

glm::dvec3 GazePath::target(Random& random, const Heading& about) const {
    const double right_sd_rad = glm::radians(terms_.saccade_deg);
    double right_rad = 0.0;
    double up_rad = 0.0;
    if (terms_.saccade_deg > 0.0) {
        do {
            right_rad = right_sd_rad * random.normal();
            up_rad = right_sd_rad * random.normal() * 2.0 / 3.0;
        } while (std::hypot(right_rad, up_rad) > 2.0 * right_sd_rad);
    }
    return orientation(about) * turned_direction(gaze::kStraightAhead, right_rad, up_rad);
}

void GazePath::plan_stay(Shift& shift, std::uint64_t event) const {
    if (terms_.saccade_deg <= 0.0) {
        shift.end_s = std::numeric_limits<double>::infinity();
        return;
    }
    shift.end_s = shift.landing_s() + Random(seed_, Stream::Fixations, event)
                                          .log_normal(terms_.fixation_ms * 1e-3, kFixationSpread);
    if (terms_.pursuit_percent > 0.0) {
        Random random(seed_, Stream::Pursuits, event);
        if (random.uniform() * 100.0 < terms_.pursuit_percent) {
            const double roll_rad = random.uniform(0.0, 2.0 * std::numbers::pi);
            const glm::dvec3& to = shift.saccade.to();
            shift.pursuit_axis = glm::angleAxis(roll_rad, to) * right_of(to);
            shift.pursuit_rad_per_s = glm::radians(terms_.pursuit_deg_per_s);
        }
    }
}

double GazePath::draw_dioptres(std::uint64_t event) const {
    if (terms_.distance_spread <= 0.0) {
        return 1.0 / terms_.distance_m;
    }
    return 1.0 / Random(seed_, Stream::Distances, event)
                     .log_normal(terms_.distance_m, terms_.distance_spread);
}

const GazePath::Shift& GazePath::shift_at(double time_s) const {
    const auto after =
        std::upper_bound(shifts_.begin(), shifts_.end(), time_s,
                         [](double time, const Shift& shift) { return time < shift.begin_s; });
    return *(after - 1);
}

glm::dvec3 GazePath::direction(const Shift& shift, double time_s) const {
    const double landing_s = shift.landing_s();
    if (time_s < landing_s) {
        return shift.saccade.at(time_s - shift.begin_s);
    }
    glm::dvec3 to = shift.saccade.to();
    if (shift.pursuit_rad_per_s > 0.0) {
        to =
            glm::angleAxis(shift.pursuit_rad_per_s * (time_s - landing_s), shift.pursuit_axis) * to;
    }
    if (head_terms_.vor_gain < 1.0 && head_terms_.moves()) {
        const glm::dquat turned =
            head_.at(time_s).orientation * glm::conjugate(head_.at(landing_s).orientation);
        to = glm::slerp(glm::dquat{1.0, 0.0, 0.0, 0.0}, turned, 1.0 - head_terms_.vor_gain) * to;
    }
    return glm::normalize(to);
}

GazePath::Point GazePath::at(double time_s) const {
    const Shift& shift = shift_at(time_s);
    const bool moving = time_s < shift.landing_s();
    const double done = moving ? shift.saccade.progress(time_s - shift.begin_s) : 1.0;
    const double dioptres = shift.from_dioptres + done * (shift.to_dioptres - shift.from_dioptres);
    const Movement stay = shift.pursuit_rad_per_s > 0.0 ? Movement::Pursuit : Movement::Fixation;
    return {.direction = direction(shift, time_s),
            .distance_m = 1.0 / dioptres,
            .movement = moving ? Movement::Saccade : stay};
}

}  // namespace gazeloop::sim
