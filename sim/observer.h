#pragma once

#include <cstdint>

#include "sim/random.h"

namespace gazeloop::sim {

/// Who answers in a simulated study. Every term is off at 0 and then draws no number. Differences
/// are in the observer's own unit: 1 is the difference that is just called one.
struct ObserverTerms {
    double noise = 0.0;    ///< deviation of what is felt, in just noticeable differences; >= 0
    double bias = 0.0;     ///< felt to be better in what came second, in the same unit
    double lapse = 0.0;    ///< share of answers given blindly, each as likely; in [0, 1]
    double fatigue = 0.0;  ///< by how much noise and criterion grow per hour in the headset; >= 0
    /// How much people differ: deviation of where on the axis of levels their threshold lies from
    /// the mean person's, in the unit of that axis; >= 0.
    double people = 0.0;
};

enum class Comparison : std::uint8_t { Same, FirstBetter, SecondBetter };

/// One simulated person. What one trial draws does not depend on what the others drew.
class Observer {
  public:
    /// `person`: which one of that seed's.
    Observer(const ObserverTerms& terms, std::uint64_t seed, std::uint64_t person);

    /// Where this person's threshold lies from the mean person's, on the axis of levels.
    [[nodiscard]] double shift() const { return shift_; }

    /// Which of two pictures looks better. `difference`: by how much the first truly does, negative
    /// if the second does. `look`: which one of all this person's looks; `hours` of them have gone
    /// by.
    [[nodiscard]] Comparison compare(double difference, std::uint64_t look, double hours) const;

    /// Whether two pictures look different that truly differ by so much, >= 0. To a person with
    /// bias equal ones may, in what came second.
    [[nodiscard]] bool sees_difference(double difference, std::uint64_t look, double hours) const;

  private:
    /// What is felt, in units of the criterion at that hour.
    [[nodiscard]] double felt(double difference, std::uint64_t look, double hours) const;
    /// Whether a look is answered blindly; `choice` is then in [0, 1).
    [[nodiscard]] bool blind(std::uint64_t look, double& choice) const;

    ObserverTerms terms_;
    std::uint64_t seed_;
    double shift_ = 0.0;
};

}  // namespace gazeloop::sim
