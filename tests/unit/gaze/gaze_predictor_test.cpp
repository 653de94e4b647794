#include "runtime/gaze/events/gaze_predictor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "runtime/gaze/events/saccade_forecast.h"
#include "runtime/gaze/main_sequence.h"

namespace gazeloop::gaze {
namespace {

constexpr std::int64_t kInterval_ns = 2'000'000;
constexpr double kInterval_s = 0.002;

glm::dvec3 right_by(double deg) {
    return {std::sin(glm::radians(deg)), 0.0, -std::cos(glm::radians(deg))};
}

double right_deg(const glm::dvec3& direction) {
    return glm::degrees(std::atan2(direction.x, -direction.z));
}

class Watched {
  public:
    void look(double deg) {
        now_ns_ += kInterval_ns;
        predictor.add(now_ns_, right_by(deg));
    }
    void rest(double deg, double seconds) {
        for (double t = 0.0; t < seconds; t += kInterval_s) {
            look(deg);
        }
    }
    /// Where the gaze is expected to be so long after the last sample.
    [[nodiscard]] double expected_deg(double ahead_s) const {
        return right_deg(prediction(ahead_s).turn *
                         predictor.detector().history().back(0).direction);
    }
    [[nodiscard]] GazePrediction prediction(double ahead_s) const {
        return predictor.predict(now_ns_ + std::llround(ahead_s * 1e9));
    }

    GazePredictor predictor;

  private:
    std::int64_t now_ns_ = 0;
};

TEST(SaccadeForecast, KnowsASaccadeOnTheMainSequence) {
    for (const double amplitude_deg : {4.0, 8.0, 15.0}) {
        constexpr double kLean = 0.2;  // large ones peak early
        const SaccadeCourse course(amplitude_deg, 1.0, kLean);
        const auto travelled = [&](double t) { return amplitude_deg * course.progress(t); };
        // Once it slows down, GazePredictor holds.
        for (const double share : {0.3, 0.4, 0.5, 0.6, 0.7}) {
            SCOPED_TRACE(amplitude_deg + share);
            const double now_s = share * course.duration_s();
            const auto speed = [&](double t) {
                return (travelled(t + 5e-4) - travelled(t - 5e-4)) / 1e-3;
            };
            const SaccadeInFlight seen{
                .travelled_deg = travelled(now_s),
                .elapsed_s = now_s - 0.01,  // noticed so late
                .speed_deg_per_s = speed(now_s),
                .peak_deg_per_s = speed(std::min(share, 0.5 - 0.25 * kLean) * course.duration_s()),
                .speed_age_s = 0.0,
                .step_deg_per_s = speed(now_s),
                .step_age_s = 0.0,
                .vigour = 1.0 / 1.23};  // exactly the main sequence
            const SaccadeForecast forecast(seen);
            const SaccadeTravel landed = forecast.after(0.2);
            EXPECT_GT(landed.sd_deg, 0.0);
            EXPECT_NEAR(landed.further_deg, amplitude_deg - travelled(now_s), 2.0 * landed.sd_deg);
            const SaccadeLanding landing = forecast.landing();
            EXPECT_NEAR(landing.in_s, course.duration_s() - now_s, 3.0 * landing.sd_s);
            const SaccadeTravel soon = forecast.after(0.005);
            EXPECT_NEAR(soon.further_deg, travelled(now_s + 0.005) - travelled(now_s),
                        0.15 * amplitude_deg);
        }
    }
}

TEST(SaccadeForecast, GoesFurtherTheLaterAndNeverBack) {
    for (double travelled_deg : {0.0, 0.5, 3.0, 12.0, 29.0}) {
        for (double speed : {10.0, 150.0, 450.0, 900.0}) {
            double before = 0.0;
            for (double ahead_s : {0.0, 0.001, 0.005, 0.02, 0.06, 1.0}) {
                const SaccadeTravel travel = SaccadeForecast({.travelled_deg = travelled_deg,
                                                              .elapsed_s = 0.02,
                                                              .speed_deg_per_s = speed,
                                                              .peak_deg_per_s = speed,
                                                              .speed_age_s = 0.002,
                                                              .step_deg_per_s = speed,
                                                              .step_age_s = 0.001})
                                                 .after(ahead_s);
                EXPECT_GE(travel.further_deg, before - 1e-9);
                EXPECT_GE(travel.sd_deg, 0.0);
                before = travel.further_deg;
            }
            EXPECT_LE(before, 45.0 - travelled_deg + 1e-9);
        }
    }
}

TEST(SaccadeForecast, KnowsNothingOfWhatNoEyeDoes) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(SaccadeForecast({.travelled_deg = 46.0}).after(0.02).further_deg, 0.0);
    EXPECT_EQ(
        SaccadeForecast({.travelled_deg = 5.0, .speed_deg_per_s = kNan}).after(0.02).further_deg,
        0.0);
    EXPECT_EQ(SaccadeForecast({.travelled_deg = 5.0, .speed_deg_per_s = kInfinity})
                  .after(0.02)
                  .further_deg,
              0.0);
    EXPECT_EQ(SaccadeForecast({.travelled_deg = 5.0, .elapsed_s = 10.0}).after(0.02).further_deg,
              0.0);
}

TEST(GazePredictor, HoldsAFixationExactly) {
    Watched watched;
    watched.rest(3.0, 0.5);
    const GazePrediction prediction = watched.prediction(0.03);
    EXPECT_EQ(prediction.verdict, PredictionVerdict::Hold);
    EXPECT_EQ(prediction.event, EyeEvent::Fixation);
    EXPECT_EQ(prediction.turn, (glm::dquat{1.0, 0.0, 0.0, 0.0}));
    EXPECT_EQ(prediction.horizon_ns, 30'000'000);
    ASSERT_TRUE(prediction.uncertainty_rad.has_value());
    EXPECT_LT(*prediction.uncertainty_rad, glm::radians(0.5));
}

TEST(GazePredictor, FollowsAPursuitByAShare) {
    Watched watched;
    for (int i = 0; i < 500; ++i) {
        watched.look(20.0 * i * kInterval_s);
    }
    const GazePrediction prediction = watched.prediction(0.05);
    EXPECT_EQ(prediction.event, EyeEvent::Pursuit);
    EXPECT_EQ(prediction.verdict, PredictionVerdict::Extrapolated);
    EXPECT_NEAR(watched.expected_deg(0.05), 20.0 * 499 * kInterval_s + 0.46, 0.02);
}

TEST(GazePredictor, IsNearerToASaccadeThanHolding) {
    for (const double amplitude_deg : {6.0, 10.0, 16.0}) {
        SCOPED_TRACE(amplitude_deg);
        const SaccadeCourse course(amplitude_deg, 1.1);
        Watched watched;
        watched.rest(0.0, 0.5);
        int extrapolated = 0;
        double held = 0.0;
        double predicted = 0.0;
        for (double t = kInterval_s; t < course.duration_s() - 0.02; t += kInterval_s) {
            const double now_deg = amplitude_deg * course.progress(t);
            watched.look(now_deg);
            const double then_deg = amplitude_deg * course.progress(t + 0.02);
            const GazePrediction prediction = watched.prediction(0.02);
            if (prediction.verdict == PredictionVerdict::Extrapolated) {
                ++extrapolated;
                held += then_deg - now_deg;
                predicted += std::abs(then_deg - watched.expected_deg(0.02));
                EXPECT_GT(glm::degrees(prediction.uncertainty_rad.value_or(0.0)), 0.1);
            }
        }
        EXPECT_GE(extrapolated, 1);
        EXPECT_LT(predicted, 0.7 * held);
    }
}

TEST(GazePredictor, DoesNotExtrapolateWhatItCannotKnow) {
    const SaccadeCourse course(10.0, 1.0);
    Watched watched;
    watched.rest(0.0, 0.5);
    bool slowed_down = false;
    for (double t = kInterval_s; t < course.duration_s(); t += kInterval_s) {
        watched.look(10.0 * course.progress(t));
        const GazePrediction prediction = watched.prediction(0.02);
        if (t < 0.006) {  // too small yet
            EXPECT_NE(prediction.verdict, PredictionVerdict::Extrapolated) << t;
        }
        if (t > 0.85 * course.duration_s() && prediction.event == EyeEvent::Saccade) {
            slowed_down = true;
            EXPECT_EQ(prediction.verdict, PredictionVerdict::DoNotExtrapolate) << t;
            EXPECT_EQ(prediction.turn, (glm::dquat{1.0, 0.0, 0.0, 0.0}));
        }
    }
    EXPECT_TRUE(slowed_down);
}

TEST(GazePredictor, BoundsTheHorizon) {
    GazePredictor predictor(20'000'000);
    for (int i = 1; i < 500; ++i) {
        predictor.add(i * kInterval_ns, right_by(20.0 * i * kInterval_s));
    }
    const std::int64_t last_ns = 499 * kInterval_ns;
    EXPECT_EQ(predictor.predict(last_ns - 5).horizon_ns, 0);
    EXPECT_EQ(predictor.predict(std::numeric_limits<std::int64_t>::min()).horizon_ns, 0);
    EXPECT_EQ(predictor.predict(last_ns + 19'000'000).horizon_ns, 19'000'000);
    const GazePrediction far = predictor.predict(std::numeric_limits<std::int64_t>::max());
    EXPECT_EQ(far.horizon_ns, 20'000'000);
    EXPECT_EQ(far.turn, predictor.predict(last_ns + 20'000'000).turn);
}

TEST(GazePredictor, SaysNothingOfALostGaze) {
    GazePredictor predictor;
    EXPECT_EQ(predictor.predict(0).verdict, PredictionVerdict::DoNotExtrapolate);
    EXPECT_FALSE(predictor.predict(0).uncertainty_rad.has_value());
    Watched watched;
    watched.rest(0.0, 0.5);
    watched.predictor.add(1'000'000'000, std::nullopt);
    const GazePrediction prediction = watched.predictor.predict(1'020'000'000);
    EXPECT_EQ(prediction.verdict, PredictionVerdict::DoNotExtrapolate);
    EXPECT_EQ(prediction.event, EyeEvent::Lost);
    EXPECT_FALSE(prediction.uncertainty_rad.has_value());
}

}  // namespace
}  // namespace gazeloop::gaze
