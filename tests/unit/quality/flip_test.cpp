#include "runtime/quality/flip.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/quality/made_pictures.h"

namespace gazeloop::quality {
namespace {

using tests::grey_picture;
using tests::made_picture;

constexpr int kWidth = 96;
constexpr int kHeight = 64;

/// A picture of 8-bit codes that anybody can make again.
std::uint8_t code(int x, int y, int c) {
    return static_cast<std::uint8_t>(
        (x * x * (3 + c) + y * y * (5 - c) + x * y * (c + 1) * 2 + (x / 16 + y / 16 + c) % 3 * 60) %
        256);
}

glm::vec3 colour(int x, int y) {
    return render::linear_of({code(x, y, 0), code(x, y, 1), code(x, y, 2)});
}

render::LinearPicture reference() { return made_picture(kWidth, kHeight, colour); }

render::LinearPicture box_average() {
    return made_picture(kWidth, kHeight, [](int x, int y) {
        const int left = x & ~1;
        const int top = y & ~1;
        return 0.25F * (colour(left, top) + colour(left + 1, top) + colour(left, top + 1) +
                        colour(left + 1, top + 1));
    });
}

render::LinearPicture moved() {
    return made_picture(kWidth, kHeight, [](int x, int y) { return colour(x + 1, y); });
}

render::LinearPicture tinted() {
    return made_picture(kWidth, kHeight, [](int x, int y) {
        const auto tint = [&](int c, int add) {
            return static_cast<std::uint8_t>(std::min(255, code(x, y, c) / 2 + add));
        };
        return render::linear_of({tint(0, 100), tint(1, 20), tint(2, 20)});
    });
}

struct Pin {
    const char* name;
    render::LinearPicture (*test)();
    double pixels_per_degree;
    double mean;
    float inside;  ///< at 10,10
    float corner;  ///< at 95,63
};

// By the authors' own program (version 1.6, LDR, its C++ header) on these pictures.
TEST(Flip, AgreesWithItsAuthorsProgram) {
    const Pin pins[] = {
        {"box average", box_average, 12.8, 0.77587157, 0.838048F, 0.682464F},
        {"moved", moved, 12.8, 0.86647391, 0.967358F, 0.806988F},
        {"tinted", tinted, 12.8, 0.74254888, 0.939820F, 0.725059F},
        {"box average", box_average, 67.0206, 0.19248115, 0.179652F, 0.314779F},
        {"moved", moved, 67.0206, 0.23377292, 0.254738F, 0.426309F},
        {"tinted", tinted, 67.0206, 0.67871547, 0.773446F, 0.662508F},
    };
    for (const Pin& pin : pins) {
        const auto result = ldr_flip(reference(), pin.test(), pin.pixels_per_degree, RowWork(2));
        ASSERT_TRUE(result);
        EXPECT_NEAR(result->mean, pin.mean, 5e-6) << pin.name << ' ' << pin.pixels_per_degree;
        EXPECT_NEAR(result->map.row(10)[10], pin.inside, 5e-6) << pin.name;
        EXPECT_NEAR(result->map.row(63)[95], pin.corner, 5e-6) << pin.name;
    }
}

TEST(Flip, IsNothingForIdenticalAndOneForTheFarthestColours) {
    const auto none = ldr_flip(reference(), reference(), 30.0, RowWork(2));
    EXPECT_EQ(none->mean, 0.0);
    // Green against blue is the largest distance of its colours.
    const auto most =
        ldr_flip(made_picture(32, 32, [](int, int) { return glm::vec3(0.0F, 1.0F, 0.0F); }),
                 made_picture(32, 32, [](int, int) { return glm::vec3(0.0F, 0.0F, 1.0F); }), 30.0,
                 RowWork(2));
    EXPECT_NEAR(most->mean, 1.0, 1e-5);
}

TEST(Flip, IsSymmetricAndTheSameWithAnyNumberOfThreads) {
    const auto forth = ldr_flip(reference(), tinted(), 20.0, RowWork(1));
    const auto back = ldr_flip(tinted(), reference(), 20.0, RowWork(3));
    EXPECT_EQ(forth->mean, back->mean);
    EXPECT_EQ(forth->map.values, back->map.values);
}

TEST(Flip, CutsWhatNoDisplayShows) {
    const auto beyond =
        ldr_flip(grey_picture(16, 16, 7.0F), grey_picture(16, 16, 1.0F), 30.0, RowWork(1));
    EXPECT_EQ(beyond->mean, 0.0);
    const auto below =
        ldr_flip(grey_picture(16, 16, -2.0F), grey_picture(16, 16, 0.0F), 30.0, RowWork(1));
    EXPECT_EQ(below->mean, 0.0);
}

TEST(Flip, WorksOnASinglePixel) {
    const auto result =
        ldr_flip(grey_picture(1, 1, 0.0F), grey_picture(1, 1, 1.0F), 67.0, RowWork(4));
    ASSERT_TRUE(result);
    EXPECT_GT(result->mean, 0.8);
}

TEST(Flip, RefusesPixelsPerDegreeOutOfRange) {
    for (const double bad : {0.0, -3.0, 301.0, std::numeric_limits<double>::quiet_NaN()}) {
        const auto result = ldr_flip(reference(), reference(), bad, RowWork(1));
        ASSERT_FALSE(result) << bad;
        EXPECT_EQ(result.error().kind, ErrorKind::Usage);
    }
}

}  // namespace
}  // namespace gazeloop::quality
