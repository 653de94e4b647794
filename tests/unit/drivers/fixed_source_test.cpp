#include "drivers/fixed/fixed_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <string_view>
#include <vector>

namespace gazeloop::drivers {
namespace {

glm::dvec3 direction_of(double azimuth_deg, double elevation_deg) {
    FixedSource source({azimuth_deg, elevation_deg});
    std::vector<gaze::GazeSample> samples;
    source.poll(0, samples);
    EXPECT_EQ(samples.at(0).eyes[0].direction, samples.at(0).eyes[1].direction);
    return samples.at(0).eyes[0].direction;
}

void expect_near(const glm::dvec3& actual, const glm::dvec3& expected) {
    EXPECT_LT(glm::length(actual - expected), 1e-15)
        << actual.x << ' ' << actual.y << ' ' << actual.z;
}

TEST(FixedSource, LooksRightForPositiveAzimuthAndUpForPositiveElevation) {
    const double half = std::sqrt(0.5);
    expect_near(direction_of(0.0, 0.0), {0.0, 0.0, -1.0});
    expect_near(direction_of(45.0, 0.0), {half, 0.0, -half});
    expect_near(direction_of(0.0, 45.0), {0.0, half, -half});
    expect_near(direction_of(-90.0, 30.0), {-std::sqrt(0.75), 0.5, 0.0});
    expect_near(direction_of(180.0, 0.0), {0.0, 0.0, 1.0});
    expect_near(direction_of(12.0, -90.0), {0.0, -1.0, 0.0});
}

TEST(FixedSource, GivesOneFreshSampleAPoll) {
    FixedSource source({5.0, -2.5});
    std::vector<gaze::GazeSample> samples;
    source.poll(100, samples);
    source.poll(200, samples);
    ASSERT_EQ(samples.size(), 2U);
    EXPECT_EQ(samples[1].sequence, samples[0].sequence + 1);
    EXPECT_EQ(samples[1].sampled, (time::Stamp{200, time::StampKind::Modelled}));
    EXPECT_EQ(samples[1].arrived, samples[1].sampled);
    EXPECT_TRUE(samples[1].eyes[0].valid && samples[1].eyes[1].valid);
    EXPECT_FALSE(samples[1].head.has_value());
    EXPECT_FALSE(source.finished());
    EXPECT_EQ(source.head_track(), nullptr);
    EXPECT_EQ(source.description(), "fixed gaze (azimuth 5 deg, elevation -2.5 deg)");
}

TEST(ParseFixedGaze, ReadsTwoAngles) {
    const Expected<FixedGaze> fixed = parse_fixed_gaze("-5,2.5");
    ASSERT_TRUE(fixed.has_value()) << fixed.error().message;
    EXPECT_EQ(fixed->azimuth_deg, -5.0);
    EXPECT_EQ(fixed->elevation_deg, 2.5);
    EXPECT_TRUE(parse_fixed_gaze("180,-90").has_value());
    EXPECT_TRUE(parse_fixed_gaze("-180,90").has_value());
}

TEST(ParseFixedGaze, RefusesEverythingElse) {
    for (const std::string_view text :
         {"", ",", "5", "5,", ",5", "5;5", "a,b", "5,5,5", "5, 5", "180.1,0", "0,-90.1", "nan,0",
          "0,nan", "inf,0", "1e999,0"}) {
        const Expected<FixedGaze> fixed = parse_fixed_gaze(text);
        ASSERT_FALSE(fixed.has_value()) << text;
        EXPECT_EQ(fixed.error().kind, ErrorKind::Usage);
        EXPECT_NE(fixed.error().message.find(text), std::string::npos);
    }
}

}  // namespace
}  // namespace gazeloop::drivers
