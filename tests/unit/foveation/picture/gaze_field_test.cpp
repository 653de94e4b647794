#include "runtime/foveation/picture/gaze_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "runtime/gaze/direction.h"
#include "tests/unit/foveation/picture/example_views.h"

namespace gazeloop::foveation {
namespace {

const std::array kGazes{kAhead,           towards(30, 0),  towards(-20, 35),
                        towards(70, 5),   towards(0, 90),  towards(0, -90),
                        towards(120, 10), towards(180, 0), glm::dvec3{0, 0, -1e-300}};

gaze::EyeView asymmetric() {
    return {.fov = {-0.9, 0.6, 0.75, -0.85}, .width_px = 1440, .height_px = 1600};
}

// At 30 degrees off axis, the circle d tan(20 deg) in pixels is truly 13.3 degrees outward and 18.0
// inward.
TEST(GazeField, EccentricityIsAnAngleNotAPixelDistance) {
    const GazeField field = GazeField::create(square_2160_view(), towards(30, 0)).value();
    const double d = 1080.0 / std::tan(glm::radians(50.0));
    const gaze::PixelPosition fovea = field.fovea();
    const double r = d * std::tan(glm::radians(20.0));
    EXPECT_NEAR(field.at(gaze::PixelPosition{fovea.x_px + r, fovea.y_px}).eccentricity_deg, 13.3,
                0.05);
    EXPECT_NEAR(field.at(gaze::PixelPosition{fovea.x_px - r, fovea.y_px}).eccentricity_deg, 18.0,
                0.07);
}

TEST(GazeField, PixelAndPolarFormsAgree) {
    for (const gaze::EyeView& view : {square_2160_view(), asymmetric()}) {
        for (const glm::dvec3& gaze : kGazes) {
            const GazeField field = GazeField::create(view, gaze).value();
            for (const double x : {0.5, 300.0, 720.25, 1439.5}) {
                for (const double y : {0.5, 800.0, 1599.5}) {
                    const FieldPoint at = field.at(gaze::PixelPosition{x, y});
                    const auto back = field.at(at.eccentricity_deg, at.direction_rad);
                    ASSERT_TRUE(back.has_value()) << x << ' ' << y;
                    EXPECT_NEAR(back->pixel.x_px, x, 1e-8);
                    EXPECT_NEAR(back->pixel.y_px, y, 1e-8);
                    const double cosine =
                        glm::dot(gaze::unproject({x, y}, view), gaze::unit(gaze).value());
                    EXPECT_NEAR(std::cos(glm::radians(at.eccentricity_deg)), cosine, 1e-12);
                }
            }
        }
    }
}

TEST(GazeField, DerivativesAreThoseOfTheProjection) {
    for (const glm::dvec3& gaze : kGazes) {
        const GazeField field = GazeField::create(asymmetric(), gaze).value();
        const FieldPoint at = field.at(gaze::PixelPosition{411.0, 1023.0});
        const double h = 1e-5;
        const double around = h / std::sin(glm::radians(at.eccentricity_deg));
        const auto difference = [&](double e, double direction) {
            const auto plus =
                field.at(at.eccentricity_deg + e, at.direction_rad + glm::radians(direction));
            const auto minus =
                field.at(at.eccentricity_deg - e, at.direction_rad - glm::radians(direction));
            return glm::dvec2{plus->pixel.x_px - minus->pixel.x_px,
                              plus->pixel.y_px - minus->pixel.y_px} /
                   (2.0 * h);
        };
        EXPECT_LT(glm::distance(difference(h, 0.0), at.px_per_deg[0]), 1e-4);
        EXPECT_LT(glm::distance(difference(0.0, around), at.px_per_deg[1]), 1e-4);
    }
}

TEST(GazeField, PixelAreasSumToTheSolidAngle) {
    const GazeField field = GazeField::create(symmetrical_view(400, 300, 90, 60), kAhead).value();
    double sum = 0.0;
    for (int y = 0; y < 300; ++y) {
        for (int x = 0; x < 400; ++x) {
            const gaze::PixelPosition pixel{x + 0.5, y + 0.5};
            sum += field.pixel_area_deg2(pixel);
            const FieldPoint at = field.at(pixel);
            EXPECT_NEAR(field.pixel_area_deg2(pixel) * std::abs(glm::determinant(at.px_per_deg)),
                        1.0, 1e-9);
        }
    }
    // A pyramid's solid angle: 4 asin(sin(a/2) sin(b/2)).
    const double solid =
        4.0 * std::asin(std::sin(glm::radians(45.0)) * std::sin(glm::radians(30.0)));
    EXPECT_NEAR(sum / (solid * glm::degrees(1.0) * glm::degrees(1.0)), 1.0, 1e-5);
}

TEST(GazeField, LeastEccentricityIsTheNearestPointOfTheRectangle) {
    for (const glm::dvec3& gaze : kGazes) {
        const GazeField field = GazeField::create(asymmetric(), gaze).value();
        for (const double x : {0.0, 512.0, 1040.0}) {
            for (const double y : {0.0, 640.0, 1200.0}) {
                double brute = 180.0;
                for (double i = 0; i <= 100; ++i) {
                    for (double j = 0; j <= 100; ++j) {
                        const gaze::PixelPosition pixel{x + 4.0 * i, y + 4.0 * j};
                        brute = std::min(brute, field.at(pixel).eccentricity_deg);
                    }
                }
                const double least = field.least_eccentricity_deg({x, y}, {x + 400, y + 400});
                EXPECT_LE(least, brute + 1e-9);
                EXPECT_NEAR(least, brute, 0.12);  // between grid points
            }
        }
    }
}

TEST(GazeField, PixelsWithinIsTheBoxAroundTheCone) {
    for (const glm::dvec3& gaze : kGazes) {
        const GazeField field = GazeField::create(asymmetric(), gaze).value();
        for (const double radius : {0.0, 0.5, 7.0, 33.0, 80.0, 89.9, 120.0, 180.0}) {
            const Tile box = field.pixels_within(radius);
            Tile brute{1440, 1600, 0, 0};
            for (std::uint32_t y = 0; y < 1600; y += 10) {
                for (std::uint32_t x = 0; x < 1440; x += 10) {
                    if (field.at(gaze::PixelPosition{x + 0.5, y + 0.5}).eccentricity_deg <=
                        radius) {
                        brute = {std::min(brute.x0, x), std::min(brute.y0, y),
                                 std::max(brute.x1, x + 1), std::max(brute.y1, y + 1)};
                    }
                }
            }
            if (brute.x1 == 0) {
                continue;
            }
            EXPECT_LE(box.x0, brute.x0) << radius;
            EXPECT_LE(box.y0, brute.y0) << radius;
            EXPECT_GE(box.x1, brute.x1) << radius;
            EXPECT_GE(box.y1, brute.y1) << radius;
            if (radius < 30.0 && gaze == kAhead) {
                EXPECT_LE(brute.x0 - box.x0, 12U) << radius;
                EXPECT_LE(box.y1 - brute.y1, 12U) << radius;
            }
        }
        EXPECT_EQ(field.pixels_within(180.0).area(), 1440U * 1600U);
    }
}

TEST(GazeField, GreatestEccentricityIsNotExceeded) {
    for (const glm::dvec3& gaze : kGazes) {
        const GazeField field = GazeField::create(asymmetric(), gaze).value();
        const double greatest = field.greatest_eccentricity_deg();
        double brute = 0.0;
        for (double y = 0; y <= 1600; y += 20) {
            for (double x = 0; x <= 1440; x += 20) {
                brute = std::max(brute, field.at(gaze::PixelPosition{x, y}).eccentricity_deg);
            }
        }
        EXPECT_GE(greatest, brute - 1e-6);
        EXPECT_LE(greatest, brute + 0.9);  // straight behind may lie between grid points
    }
}

TEST(GazeField, RefusesWhatCannotBeLookedAt) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    for (const glm::dvec3 gaze : {glm::dvec3{0.0}, glm::dvec3{kNan, 0, -1},
                                  glm::dvec3{std::numeric_limits<double>::infinity(), 0, 0}}) {
        const auto field = GazeField::create(square_2160_view(), gaze);
        ASSERT_FALSE(field.has_value());
        EXPECT_EQ(field.error().kind, ErrorKind::Usage);
        EXPECT_THAT(field.error().message, testing::HasSubstr("gaze direction"));
    }
    for (const gaze::EyeView& view :
         {symmetrical_view(0, 100, 90, 90), symmetrical_view(100, 0, 90, 90),
          symmetrical_view(16385, 100, 90, 90), symmetrical_view(100, 100, 180, 90),
          symmetrical_view(100, 100, 0, 90), symmetrical_view(100, 100, kNan, 90)}) {
        const auto field = GazeField::create(view, kAhead);
        ASSERT_FALSE(field.has_value());
        EXPECT_THAT(field.error().message, testing::HasSubstr("1 to 16384 px"));
    }
    EXPECT_TRUE(GazeField::create(symmetrical_view(1, 1, 1, 179), kAhead).has_value());
    EXPECT_TRUE(GazeField::create(symmetrical_view(16384, 16384, 170, 170), kAhead).has_value());
}

}  // namespace
}  // namespace gazeloop::foveation
