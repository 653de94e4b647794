// A term that is off draws no random number. Built with tests/support/counting_random.
#include <gtest/gtest.h>

#include <optional>
#include <ostream>
#include <string>

#include "sim/eye_tracker.h"
#include "sim/gaze_simulation.h"
#include "sim/person.h"
#include "sim/random.h"

namespace gazeloop::sim {
namespace {

/// A term that has a stream of its own.
struct DrawingTerm {
    const char* key;
    double on;
    Stream stream;
};
void PrintTo(const DrawingTerm& term, std::ostream* out) { *out << term.key; }

constexpr DrawingTerm kTerms[] = {
    {"head.sway_deg", 1.5, Stream::Sway},
    {"head.turn_percent", 25.0, Stream::Turns},
    {"saccade_scatter_percent", 15.0, Stream::SaccadeScatter},
    {"distance_spread", 0.3, Stream::Distances},
    {"pursuit_percent", 20.0, Stream::Pursuits},
    {"drift_deg", 0.15, Stream::Drift},
    {"microsaccades_per_s", 1.5, Stream::Microsaccades},
    {"blinks_per_min", 15.0, Stream::Blinks},
    {"bias_deg", 0.5, Stream::Bias},
    {"noise_deg", 0.2, Stream::Noise},
    {"jitter_ms", 1.0, Stream::Jitter},
    {"dropout_percent", 5.0, Stream::Dropouts},
    {"eye_loss_percent", 5.0, Stream::EyeLosses},
};

void set(GazeSimulation& simulation, std::string_view key, double value) {
    for (const Term& term : terms_of(simulation)) {
        if (term.key == key) {
            *term.value = value;
            return;
        }
    }
    FAIL() << "no term " << key;
}

GazeSimulation with_all(bool on) {
    GazeSimulation simulation;
    for (const DrawingTerm& term : kTerms) {
        set(simulation, term.key, on ? term.on : 0.0);
    }
    return simulation;
}

/// What two minutes draw, by stream.
auto draws(const GazeSimulation& simulation) {
    g_draws = {};
    Person person(simulation.eye, simulation.head, simulation.seed);
    EyeTracker tracker(simulation.tracker, simulation.seed, 0);
    std::optional<gaze::GazeSample> last;
    while (tracker.earliest_arrival_ns() < 120'000'000'000) {
        last = tracker.step(person);
    }
    return g_draws;
}

class Draws : public testing::TestWithParam<DrawingTerm> {};

// Alone, and among all others.
TEST_P(Draws, ATermThatIsOffDrawsNothing) {
    const DrawingTerm& term = GetParam();
    const auto stream = static_cast<std::size_t>(term.stream);
    GazeSimulation simulation = with_all(false);
    EXPECT_EQ(draws(simulation)[stream], 0U);
    set(simulation, term.key, term.on);
    EXPECT_GT(draws(simulation)[stream], 0U);
    simulation = with_all(true);
    const auto all = draws(simulation);
    EXPECT_GT(all[stream], 0U);
    set(simulation, term.key, 0.0);
    const auto others = draws(simulation);
    EXPECT_EQ(others[stream], 0U);
}

INSTANTIATE_TEST_SUITE_P(Terms, Draws, testing::ValuesIn(kTerms), [](const auto& instance) {
    std::string name = instance.param.key;
    for (char& letter : name) {
        letter = letter == '.' ? '_' : letter;
    }
    return name;
});

TEST(Draws, GazeThatStaysDrawsNothing) {
    GazeSimulation simulation = with_all(false);
    simulation.eye.saccade_deg = 0.0;
    for (const std::size_t drawn : draws(simulation)) {
        EXPECT_EQ(drawn, 0U);
    }
}

// What makes noise, bias, gaps and turns larger has no numbers of its own.
TEST(Draws, GrowthAndLengthDrawNothingOfTheirOwn) {
    const GazeSimulation plain = with_all(false);
    GazeSimulation grown = plain;
    grown.tracker.bias_growth_percent = 5.0;
    grown.tracker.noise_growth_percent = 3.0;
    grown.tracker.dropout_ms = 100.0;
    grown.eye.pursuit_deg_per_s = 30.0;
    grown.head.turn_deg = 30.0;
    grown.head.vor_gain = 0.5;
    EXPECT_EQ(draws(grown), draws(plain));
}

}  // namespace
}  // namespace gazeloop::sim
