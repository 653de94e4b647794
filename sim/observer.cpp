#include "sim/observer.h"

#include <cmath>

namespace gazeloop::sim {
namespace {

/// People of one seed are independent of each other.
std::uint64_t seed_of(std::uint64_t seed, std::uint64_t person) {
    return seed ^ (0x9E3779B97F4A7C15U * (person + 1));
}

}  // namespace

Observer::Observer(const ObserverTerms& terms, std::uint64_t seed, std::uint64_t person)
    : terms_(terms), seed_(seed_of(seed, person)) {
    if (terms.people > 0.0) {
        shift_ = terms.people * Random(seed_, Stream::ObserverPeople).normal();
    }
}

double Observer::felt(double difference, std::uint64_t look, double hours) const {
    const double tired = 1.0 + terms_.fatigue * hours;
    double felt = difference;
    if (terms_.noise > 0.0) {
        felt += terms_.noise * tired * Random(seed_, Stream::ObserverNoise, look).normal();
    }
    return felt / tired;
}

bool Observer::blind(std::uint64_t look, double& choice) const {
    if (!(terms_.lapse > 0.0)) {
        return false;
    }
    Random random(seed_, Stream::ObserverLapses, look);
    const bool lapsed = random.uniform() < terms_.lapse;
    choice = random.uniform();
    return lapsed;
}

Comparison Observer::compare(double difference, std::uint64_t look, double hours) const {
    if (double choice = 0.0; blind(look, choice)) {
        return static_cast<Comparison>(static_cast<int>(3.0 * choice));
    }
    const double felt = this->felt(difference - terms_.bias, look, hours);
    return felt > 1.0    ? Comparison::FirstBetter
           : felt < -1.0 ? Comparison::SecondBetter
                         : Comparison::Same;
}

bool Observer::sees_difference(double difference, std::uint64_t look, double hours) const {
    if (double choice = 0.0; blind(look, choice)) {
        return choice < 0.5;
    }
    return felt(difference + terms_.bias, look, hours) > 1.0;
}

}  // namespace gazeloop::sim
