#include "runtime/gaze/filter/fixation_filter.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "runtime/gaze/direction.h"

namespace gazeloop::gaze {

glm::dvec3 FixationFilter::add(std::int64_t time_ns, const glm::dvec3& direction, EyeEvent event) {
    if (event != EyeEvent::Fixation) {
        reset();
        delay_s_ = 0.0;
        return direction;
    }
    const bool goes_on = last_ns_ && time_ns > *last_ns_ &&
                         glm::distance(direction, mean_) <= glm::radians(parameters_.departs_deg);
    if (!goes_on) {
        count_ = 1;
        mean_ = direction;
        delay_s_ = 0.0;
    } else {
        const double elapsed_s =
            static_cast<double>(static_cast<__int128>(time_ns) - *last_ns_) * 1e-9;
        ++count_;
        const double weight = std::max(1.0 / static_cast<double>(count_),
                                       elapsed_s / (parameters_.memory_s + elapsed_s));
        mean_ = unit(mean_ + weight * (direction - mean_)).value_or(direction);
        delay_s_ = (1.0 - weight) * (delay_s_ + elapsed_s);
    }
    last_ns_ = time_ns;
    return mean_;
}

}  // namespace gazeloop::gaze
