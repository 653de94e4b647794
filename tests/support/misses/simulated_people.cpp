#include "tests/support/misses/simulated_people.h"

#include <algorithm>

#include "sim/random.h"

namespace gazeloop::tests {

sim::GazeSimulation simulated_person(std::uint64_t number, const sim::TrackerTerms& tracker) {
    sim::Random random(number, sim::Stream::ObserverPeople);
    sim::GazeSimulation person{.seed = number, .tracker = tracker};
    sim::EyeTerms& eye = person.eye;
    eye.fixation_ms = random.log_normal(eye.fixation_ms, 0.2);
    eye.saccade_deg = std::min(random.log_normal(eye.saccade_deg, 0.2), 14.0);
    eye.drift_deg = random.log_normal(eye.drift_deg, 0.4);
    eye.microsaccades_per_s = random.log_normal(eye.microsaccades_per_s, 0.4);
    eye.blinks_per_min = std::min(random.log_normal(eye.blinks_per_min, 0.4), 40.0);
    eye.pursuit_percent = random.uniform(0.0, 20.0);
    eye.pursuit_deg_per_s = random.log_normal(eye.pursuit_deg_per_s, 0.3);
    eye.distance_spread = 0.3;
    return person;
}

}  // namespace gazeloop::tests
