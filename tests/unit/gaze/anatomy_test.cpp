#include "runtime/gaze/anatomy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/unit/gaze/pair_of_eyes.h"

namespace gazeloop::gaze {
namespace {

using ::testing::HasSubstr;

AnatomyVerdict verdict_of(const std::vector<GazeSample>& samples) {
    return anatomy_of(samples).verdict;
}

/// An angle between the eyes and the tracker's noise, by its standard deviation in each eye.
std::vector<GazeSample> noisy(double vergence_deg, double noise_deg) {
    std::vector<GazeSample> samples = pair_of_eyes(vergence_deg, 2000);
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0.0, noise_deg);
    for (GazeSample& sample : samples) {
        for (EyeRay& ray : sample.eyes) {
            const double right_deg = glm::degrees(std::atan2(ray.direction.x, -ray.direction.z));
            const double up_deg = glm::degrees(std::asin(ray.direction.y));
            ray.direction = looking(right_deg + noise(random), up_deg + noise(random));
        }
    }
    return samples;
}

TEST(Anatomy, AgreesWithAPairOfEyes) {
    const Anatomy anatomy = anatomy_of(pair_of_eyes());
    EXPECT_EQ(anatomy.verdict, AnatomyVerdict::Agrees);
    EXPECT_FALSE(anatomy.doubtful());
    EXPECT_NEAR(anatomy.apart_m.value(), 0.064, 1e-9);
    EXPECT_NEAR(anatomy.vergence_deg->median, 2.4, 1e-9);
    EXPECT_EQ(anatomy.directions, (PerEye<std::uint64_t>{400, 400}));
    EXPECT_EQ(anatomy_text(anatomy),
              "agree with anatomy (left eye 64 mm left of the right one, median vergence 2.4 deg)");
}

TEST(Anatomy, KnowsGazeBehindTheHead) {
    const auto behind = changed(pair_of_eyes(), [](EyeRay& left, EyeRay& right) {
        left.direction.z *= -1.0;
        right.direction.z *= -1.0;
    });
    EXPECT_EQ(verdict_of(behind), AnatomyVerdict::Behind);
    EXPECT_THAT(anatomy_text(anatomy_of(behind)), HasSubstr("100 % of the gaze points behind"));
    const auto one =
        changed(pair_of_eyes(), [](EyeRay& left, EyeRay&) { left.direction.z *= -1.0; });
    EXPECT_EQ(verdict_of(one), AnatomyVerdict::PartlyBehind);
    EXPECT_EQ(anatomy_text(anatomy_of(one)), "all gaze of the left eye points behind the head");
}

/// One eye is enough to see that, and any number of samples.
TEST(Anatomy, KnowsOneEyesGazeBehindTheHead) {
    const auto behind = changed(pair_of_eyes(2.4, 3), [](EyeRay& left, EyeRay& right) {
        left.direction.z *= -1.0;
        right.valid = false;
    });
    EXPECT_EQ(verdict_of(behind), AnatomyVerdict::Behind);
}

TEST(Anatomy, BearsGlitchesButNotEveryTenthDirection) {
    const auto behind_every = [](std::size_t step) {
        std::vector<GazeSample> samples = pair_of_eyes();
        for (std::size_t i = 0; i < samples.size(); i += step) {
            samples[i].eyes[0].direction.z *= -1.0;
            samples[i].eyes[1].direction.z *= -1.0;
        }
        return samples;
    };
    EXPECT_EQ(verdict_of(behind_every(25)), AnatomyVerdict::Agrees);
    EXPECT_EQ(verdict_of(behind_every(10)), AnatomyVerdict::PartlyBehind);
}

TEST(Anatomy, KnowsRaysThatDiverge) {
    EXPECT_EQ(verdict_of(pair_of_eyes(-2.4)), AnatomyVerdict::Diverging);
    EXPECT_THAT(anatomy_text(anatomy_of(pair_of_eyes(-2.4))),
                HasSubstr("diverge (median -2.4 deg"));
    EXPECT_EQ(verdict_of(pair_of_eyes(-1.01)), AnatomyVerdict::Diverging);
    EXPECT_EQ(verdict_of(pair_of_eyes(-0.99)), AnatomyVerdict::Agrees);
}

/// Places are not needed for that.
TEST(Anatomy, KnowsRaysThatDivergeWithoutPlaces) {
    const auto nowhere = [](EyeRay& left, EyeRay& right) {
        left.origin_m = right.origin_m = glm::dvec3{0.0};
    };
    EXPECT_EQ(verdict_of(changed(pair_of_eyes(-2.4), nowhere)), AnatomyVerdict::Diverging);
    const Anatomy anatomy = anatomy_of(changed(pair_of_eyes(), nowhere));
    EXPECT_EQ(anatomy.verdict, AnatomyVerdict::Agrees);
    EXPECT_FALSE(anatomy.apart_m);
}

TEST(Anatomy, KnowsALeftEyeOnTheRight) {
    const auto mirrored = [](EyeRay& left, EyeRay& right) {
        left.origin_m.x *= -1.0;
        right.origin_m.x *= -1.0;
    };
    EXPECT_EQ(verdict_of(changed(pair_of_eyes(), mirrored)), AnatomyVerdict::PlacesExchanged);
    EXPECT_EQ(verdict_of(changed(pair_of_eyes(-2.4), mirrored)), AnatomyVerdict::Exchanged);
    EXPECT_EQ(verdict_of(changed(pair_of_eyes(0.1), mirrored)), AnatomyVerdict::Exchanged);
    const auto exchanged =
        changed(pair_of_eyes(), [](EyeRay& left, EyeRay& right) { std::swap(left, right); });
    EXPECT_EQ(verdict_of(exchanged), AnatomyVerdict::Exchanged);
}

/// What lies closer than any pupils, or is not given, says nothing.
TEST(Anatomy, TakesNoSideFromPlacesThatAreClose) {
    const auto at = [](double x_m) {
        return changed(pair_of_eyes(), [x_m](EyeRay& left, EyeRay& right) {
            left.origin_m.x = x_m;
            right.origin_m.x = 0.0;
        });
    };
    EXPECT_EQ(verdict_of(at(0.019)), AnatomyVerdict::Agrees);
    EXPECT_EQ(verdict_of(at(0.021)), AnatomyVerdict::PlacesExchanged);
}

TEST(Anatomy, KnowsOneMirroredEye) {
    const auto one_mirrored = [](EyeRay&, EyeRay& right) { right.direction.x *= -1.0; };
    EXPECT_EQ(verdict_of(changed(pair_of_eyes(2.4, 400, 0.0), one_mirrored)),
              AnatomyVerdict::OneMirrored);
    // All of it to one side.
    EXPECT_EQ(verdict_of(changed(pair_of_eyes(2.4, 400, 20.0), one_mirrored)),
              AnatomyVerdict::OneMirrored);
    EXPECT_EQ(verdict_of(changed(pair_of_eyes(2.4, 400, -20.0), one_mirrored)),
              AnatomyVerdict::OneMirrored);
    const auto one_upended = changed(pair_of_eyes(2.4, 400, 0.0),
                                     [](EyeRay&, EyeRay& right) { right.direction.y *= -1.0; });
    EXPECT_EQ(verdict_of(one_upended), AnatomyVerdict::OneUpended);
}

/// Following a finger to the nose, the eyes go against each other too.
TEST(Anatomy, TakesNoVergenceForAMirroredEye) {
    std::vector<GazeSample> samples = pair_of_eyes();
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double each_deg = 5.5 + 5.0 * std::sin(0.05 * static_cast<double>(i));
        samples[i].eyes[0].direction = looking(each_deg, 0.0);
        samples[i].eyes[1].direction = looking(-each_deg, 0.0);
    }
    EXPECT_EQ(verdict_of(samples), AnatomyVerdict::Agrees);
}

TEST(Anatomy, IsNotMisledByNoiseOrASmallError) {
    EXPECT_EQ(verdict_of(noisy(0.0, 3.0)), AnatomyVerdict::Agrees);
    EXPECT_EQ(verdict_of(noisy(-0.7, 1.0)), AnatomyVerdict::Agrees);
    EXPECT_EQ(verdict_of(noisy(-2.4, 0.5)), AnatomyVerdict::Diverging);
    // More noise than angle: less than three quarters diverge.
    EXPECT_EQ(verdict_of(noisy(-1.5, 3.0)), AnatomyVerdict::Agrees);
}

/// Gaze of a headset that was recorded: medians of .05 to .3 degrees, quartiles down to -1.2.
TEST(Anatomy, AgreesWithRecordedGaze) {
    EXPECT_EQ(verdict_of(noisy(0.07, 0.6)), AnatomyVerdict::Agrees);
    EXPECT_EQ(verdict_of(noisy(0.28, 0.75)), AnatomyVerdict::Agrees);
    EXPECT_EQ(verdict_of(noisy(0.05, 1.0)), AnatomyVerdict::Agrees);
}

TEST(Anatomy, TakesALargeAngleForASquint) {
    EXPECT_EQ(verdict_of(pair_of_eyes(-14.9)), AnatomyVerdict::Diverging);
    const Anatomy outwards = anatomy_of(pair_of_eyes(-15.1));
    EXPECT_EQ(outwards.verdict, AnatomyVerdict::Unknown);
    EXPECT_THAT(anatomy_text(outwards), HasSubstr("15.1 deg apart: a squint"));
    EXPECT_EQ(verdict_of(pair_of_eyes(20.0)), AnatomyVerdict::Agrees) << "inwards";
}

TEST(Anatomy, SaysWhatCannotBeTold) {
    const auto text_of = [](const std::vector<GazeSample>& samples) {
        const Anatomy anatomy = anatomy_of(samples);
        EXPECT_EQ(anatomy.verdict, AnatomyVerdict::Unknown);
        return anatomy_text(anatomy);
    };
    EXPECT_THAT(text_of(pair_of_eyes(-2.4, AnatomyCheck::kEnough - 1)),
                HasSubstr("from 19 samples with both eyes"));
    EXPECT_EQ(verdict_of(pair_of_eyes(-2.4, AnatomyCheck::kEnough)), AnatomyVerdict::Diverging);
    EXPECT_THAT(
        text_of(changed(pair_of_eyes(-2.4), [](EyeRay&, EyeRay& right) { right.valid = false; })),
        HasSubstr("from one eye"));
    EXPECT_THAT(
        text_of(changed(pair_of_eyes(-2.4),
                        [](EyeRay& left, EyeRay& right) { right.direction = left.direction; })),
        HasSubstr("from one ray for both eyes"));
    EXPECT_THAT(text_of({}), HasSubstr("no gaze"));
}

/// One ray that was split where the eyes were assumed to look meets there by construction.
TEST(Anatomy, LearnsNothingFromASplitRay) {
    std::vector<GazeSample> samples = pair_of_eyes(-2.4);
    for (GazeSample& sample : samples) {
        sample.parallax_rad = 0.05;
    }
    EXPECT_EQ(verdict_of(samples), AnatomyVerdict::Unknown);
}

TEST(Anatomy, LooksThroughLongTracesInSteps) {
    std::vector<GazeSample> samples = pair_of_eyes(2.4, 100'000);
    for (std::size_t i = 30'000; i < samples.size(); ++i) {
        samples[i].eyes[0].direction.z *= -1.0;
        samples[i].eyes[1].direction.z *= -1.0;
    }
    EXPECT_EQ(verdict_of(samples), AnatomyVerdict::Behind) << "not only at its begin";
}

}  // namespace
}  // namespace gazeloop::gaze
