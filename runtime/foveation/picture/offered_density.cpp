#include "runtime/foveation/picture/offered_density.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace gazeloop::foveation {

double SampleGrid::worst_density() const {
    // Gauss's reduction of a lattice in two dimensions. Each step but the last shortens the longer
    // vector by at least a factor of sqrt(3). The limit is for vectors that are not finite.
    glm::dvec2 shorter = first;
    glm::dvec2 longer = second;
    for (int step = 0; step < 64; ++step) {
        if (glm::dot(shorter, shorter) > glm::dot(longer, longer)) {
            std::swap(shorter, longer);
        }
        const double length2 = glm::dot(shorter, shorter);
        const double turns = length2 > 0.0 ? std::round(glm::dot(shorter, longer) / length2) : 0.0;
        if (turns == 0.0) {
            break;
        }
        longer -= turns * shorter;
    }
    return glm::length(shorter);
}

SampleGrid SampleGrid::in_degrees(const FieldPoint& at) const {
    // The chain rule; GLM multiplies a row vector from the left.
    return {first * at.px_per_deg, second * at.px_per_deg};
}

}  // namespace gazeloop::foveation
