// What the foveated contrast metric must do, whatever its figures.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "runtime/foveation/eye/stela_csf.h"
#include "runtime/foveation/picture/gaze_frame.h"
#include "runtime/quality/foveated_contrast.h"
#include "tests/unit/quality/made_pictures.h"

namespace gazeloop::quality {
namespace {

using tests::box_blurred;
using tests::flat_view;
using tests::grey_picture;
using tests::looking;
using tests::made_picture;
using tests::textured_picture;

const glm::dvec3 kAhead = looking(0.0);

FoveatedContrast metric(const gaze::EyeView& view, unsigned threads = 2) {
    return FoveatedContrast::create(view, gaze::Eye::Left, {.light = {}, .threads = threads})
        .value();
}

double value(const render::LinearPicture& reference, const render::LinearPicture& test,
             const glm::dvec3& gaze = kAhead, double half_deg = 25.0) {
    return metric(flat_view(reference.width, reference.height, half_deg))
        .still(reference, test, gaze)
        .value()
        .value;
}

render::LinearPicture with_noise(render::LinearPicture picture, float amplitude) {
    std::mt19937 random(7);
    for (glm::vec3& pixel : picture.pixels) {
        pixel += amplitude * (static_cast<float>(random() >> 8U) * 0x1p-24F - 0.5F);
    }
    return picture;
}

TEST(FoveatedContrast, OfIdenticalPicturesIsNothing) {
    for (const std::uint32_t side : {1U, 2U, 7U, 64U, 129U}) {
        const auto picture = textured_picture(side, side);
        const auto result =
            metric(flat_view(side, side, 25.0)).still(picture, picture, kAhead, true);
        EXPECT_EQ(result->value, 0.0);
        EXPECT_EQ(result->map.values, std::vector<float>(std::size_t{side} * side));
    }
}

TEST(FoveatedContrast, IsSymmetricToTheBit) {
    const auto a = textured_picture(150, 120);
    const auto b = box_blurred(a, 2);
    auto compared = metric(flat_view(150, 120, 25.0));
    const auto forth = compared.still(a, b, looking(4.0, 3.0), true).value();
    const auto back = compared.still(b, a, looking(4.0, 3.0), true).value();
    EXPECT_EQ(forth.value, back.value);
    EXPECT_EQ(forth.map.values, back.map.values);
    EXPECT_GT(forth.value, 0.05);
}

TEST(FoveatedContrast, IsTheSameWithAnyNumberOfThreads) {
    const auto a = textured_picture(300, 200);
    const auto b = box_blurred(a, 1);
    const auto view = flat_view(300, 200, 30.0);
    const auto one = metric(view, 1).next(a, b, kAhead, 0.011, true).value();
    const auto five = metric(view, 5).next(a, b, kAhead, 0.011, true).value();
    EXPECT_EQ(one.value, five.value);
    EXPECT_EQ(one.map.values, five.map.values);
}

TEST(FoveatedContrast, RisesWithBlurAndNoise) {
    const auto clean = textured_picture(200, 200);
    double before = 0.0;
    for (const int reach : {1, 2, 3, 5, 8, 12}) {
        const double blurred = value(clean, box_blurred(clean, reach));
        EXPECT_GT(blurred, before) << reach;
        before = blurred;
    }
    before = 0.0;
    for (const float amplitude : {0.002F, 0.01F, 0.03F, 0.1F, 0.3F}) {
        const double noisy = value(clean, with_noise(clean, amplitude));
        EXPECT_GT(noisy, before) << amplitude;
        before = noisy;
    }
}

/// What kernel foveated rendering shows of a picture: each pixel takes the colour of its LP-texel's
/// centre (B, r = exp(L (u/w)^(1/alpha))).
render::LinearPicture foveated(const render::LinearPicture& picture, double sigma, double alpha,
                               double fovea_x, double fovea_y) {
    const double w = picture.width / sigma;
    const double h = picture.height / sigma;
    const double log_max = std::log(std::hypot(picture.width, picture.height) / 2.0);
    return made_picture(picture.width, picture.height, [&](int x, int y) {
        const double dx = x + 0.5 - fovea_x;
        const double dy = y + 0.5 - fovea_y;
        const double r = std::max(1.0, std::hypot(dx, dy));
        const double u = std::floor(w * std::pow(std::log(r) / log_max, alpha)) + 0.5;
        const double turn = 2.0 * std::numbers::pi;
        const double v = std::floor(h * (std::atan2(dy, dx) / turn + 1.0)) + 0.5;
        const double at_r = std::exp(log_max * std::pow(u / w, 1.0 / alpha));
        const double angle = v / h * turn;
        const auto clamped = [](double at, std::uint32_t side) {
            return static_cast<std::size_t>(
                std::clamp(std::floor(at), 0.0, static_cast<double>(side) - 1.0));
        };
        return picture
            .pixels[clamped(fovea_y + at_r * std::sin(angle), picture.height) * picture.width +
                    clamped(fovea_x + at_r * std::cos(angle), picture.width)];
    });
}

TEST(FoveatedContrast, RisesWithSigma) {
    const auto clean = textured_picture(256, 256);
    double before = 0.0;
    for (const double sigma : {1.2, 1.8, 2.4, 3.2, 4.5, 6.0}) {
        const double shown = value(clean, foveated(clean, sigma, 4.0, 128.0, 128.0));
        EXPECT_GT(shown, before) << sigma;
        before = shown;
    }
}

TEST(FoveatedContrast, IsLeastWhereThePictureWasMadeToBeSeen) {
    const auto clean = textured_picture(256, 256);
    const auto blurred = box_blurred(clean, 2);
    // Sharp within some 12 degrees of straight ahead.
    const auto shown = made_picture(256, 256, [&](int x, int y) {
        const auto at = static_cast<std::size_t>(y * 256 + x);
        return std::hypot(x - 128, y - 128) < 60.0 ? clean.pixels[at] : blurred.pixels[at];
    });
    EXPECT_LT(value(clean, shown, kAhead), 0.8 * value(clean, shown, looking(18.0)));
}

TEST(FoveatedContrast, FallsWithEccentricity) {
    const auto clean = textured_picture(240, 240);
    auto spoilt = clean;
    const auto blurred = box_blurred(clean, 2);
    for (std::size_t y = 110; y < 130; ++y) {
        for (std::size_t x = 110; x < 130; ++x) {
            spoilt.pixels[y * 240 + x] = blurred.pixels[y * 240 + x];
        }
    }
    const double in_the_fovea = value(clean, spoilt);
    double before = std::numeric_limits<double>::infinity();
    for (const double away_deg : {0.0, 3.0, 8.0, 15.0, 30.0, 60.0, 120.0}) {
        const double seen =
            value(clean, spoilt,
                  {std::sin(glm::radians(away_deg)), 0.0, -std::cos(glm::radians(away_deg))});
        EXPECT_LT(seen, before) << away_deg;
        EXPECT_GE(seen, 0.0);
        before = seen;
    }
    EXPECT_LT(before, 0.02 * in_the_fovea);
}

/// A patch of texture in angles around a direction, in a grey field.
render::LinearPicture patch_at(const gaze::EyeView& view, const glm::dvec3& middle, double fine) {
    const foveation::GazeFrame frame(view, middle);
    return made_picture(view.width_px, view.height_px, [&](int x, int y) {
        const auto polar = frame.polar({x + 0.5, y + 0.5});
        const double e_deg = glm::degrees(2.0 * std::atan(polar.rho));
        const double across = e_deg * std::cos(polar.angle_rad);
        const double along = e_deg * std::sin(polar.angle_rad);
        const auto wave = [&](double cpd, double turn) {
            return std::sin(2.0 * std::numbers::pi * cpd *
                            (across * std::cos(turn) + along * std::sin(turn)));
        };
        const double texture = wave(0.5, 0.3) + wave(1.0, 1.9) + 0.6 * wave(1.7, 1.1) +
                               fine * (0.6 * wave(2.6, 2.4) + 0.4 * wave(3.7, 0.8));
        return glm::vec3(
            static_cast<float>(0.4 + 0.05 * texture * std::exp(-e_deg * e_deg / 40.0)));
    });
}

// Gaze and picture move together: on the display the pixels are others, in angles all is the same.
TEST(FoveatedContrast, IsTheSameInAnglesWhereverTheGazeIs) {
    const gaze::EyeView view = flat_view(480, 480, 20.0);
    auto compared = metric(view);
    const auto at = [&](const glm::dvec3& gaze) {
        return compared.still(patch_at(view, gaze, 1.0), patch_at(view, gaze, 0.3), gaze)
            .value()
            .value;
    };
    const double ahead = at(kAhead);
    EXPECT_GT(ahead, 0.1);
    for (const auto& gaze : {looking(3.0), looking(-6.5, 2.0), looking(10.0), looking(0.0, -10.0),
                             looking(7.0, 7.0)}) {
        EXPECT_NEAR(at(gaze) / ahead, 1.0, 0.02) << glm::degrees(std::atan(gaze.x));
    }
}

// A grating whose contrast is the threshold by stelaCSF, seen by the fovea: the map must say 1,
// which is .707 in root mean square over the grating's phases.
TEST(FoveatedContrast, CallsTheThresholdOfStelaCsfOne) {
    constexpr std::uint32_t kSide = 384;
    const gaze::EyeView view = flat_view(kSide, kSide, 7.5);
    const double per_deg = foveation::pixels_per_degree(view, {0.0, 0.0, -1.0}).mean;
    auto compared = FoveatedContrast::create(view, gaze::Eye::Left,
                                             {.light = {.peak_cd_m2 = 100.0, .black_cd_m2 = 0.0}})
                        .value();
    for (const double cycles_per_px : {0.3, 0.15, 0.1, 0.075, 0.05}) {
        const double sensitivity = foveation::stela_sustained_sensitivity(
            cycles_per_px * per_deg, {.luminance_cd_m2 = 50.0});
        const auto grating = made_picture(kSide, kSide, [&](int x, int) {
            return glm::vec3(static_cast<float>(
                0.5 + 0.5 / sensitivity * std::sin(2.0 * std::numbers::pi * cycles_per_px * x)));
        });
        const auto map =
            compared.still(grey_picture(kSide, kSide, 0.5F), grating, kAhead, true)->map;
        double squares = 0.0;
        for (std::uint32_t x = 182; x < 202; ++x) {
            squares += static_cast<double>(map.row(192)[x] * map.row(192)[x]) / 20.0;
        }
        EXPECT_NEAR(std::sqrt(squares) / std::numbers::sqrt2 * 2.0, 1.0, 0.3) << cycles_per_px;
    }
}

TEST(FoveatedContrast, SeesLessBesideTexture) {
    const auto busy = textured_picture(200, 200);
    const auto plain = grey_picture(200, 200, 0.4F);
    EXPECT_LT(value(busy, with_noise(busy, 0.03F)), 0.8 * value(plain, with_noise(plain, 0.03F)));
}

TEST(FoveatedContrast, TellsColourFromLuminance) {
    const auto grey = grey_picture(128, 128, 0.4F);
    auto compared = metric(flat_view(128, 128, 25.0));
    const auto of_stripes = [&](const glm::vec3& stripe) {
        return compared
            .still(grey,
                   made_picture(128, 128,
                                [&](int x, int) {
                                    return glm::vec3(0.4F) + (x / 8 % 2 == 0 ? stripe : -stripe);
                                }),
                   kAhead)
            .value()
            .mechanisms;
    };
    const auto luminous = of_stripes(glm::vec3(0.02F));
    EXPECT_GT(luminous[0], 10.0 * luminous[1]);
    EXPECT_GT(luminous[0], 10.0 * luminous[2]);
    // Red against green of one luminance (about: the primaries' shares are .21 and .72).
    const auto red_green = of_stripes(glm::vec3(0.068F, -0.02F, 0.0F));
    EXPECT_GT(red_green[1], 2.0 * red_green[0]);
    const auto blue = of_stripes(glm::vec3(-0.003F, -0.003F, 0.05F));
    EXPECT_GT(blue[2], 2.0 * blue[0]);
}

TEST(FoveatedContrast, OfAStillSequenceIsThatOfTheStill) {
    const auto a = textured_picture(120, 100);
    const auto b = box_blurred(a, 2);
    auto compared = metric(flat_view(120, 100, 25.0));
    const double still = compared.still(a, b, kAhead)->value;
    for (int frame = 0; frame < 5; ++frame) {
        const auto result = compared.next(a, b, kAhead, 1.0 / 90.0).value();
        EXPECT_NEAR(result.value, still, 1e-4 * still);
        EXPECT_LT(result.mechanisms[static_cast<std::size_t>(Mechanism::Transient)], 1e-3);
    }
}

/// The mean flicker of a second at 90 Hz: the whole test picture, or a patch in its middle, is
/// brighter and darker in turns.
double flicker(double hz, float amplitude, const glm::dvec3& gaze = kAhead) {
    constexpr int kFrames = 90;
    const auto steady = textured_picture(96, 96);
    auto compared = metric(flat_view(96, 96, 25.0));
    double sum = 0.0;
    for (int frame = 0; frame < kFrames; ++frame) {
        const auto phase = static_cast<float>(std::sin(2.0 * std::numbers::pi * hz * frame / 90.0));
        const auto shown = made_picture(96, 96, [&](int x, int y) {
            const bool patch = std::abs(x - 48) < 8 && std::abs(y - 48) < 8;
            return steady.pixels[static_cast<std::size_t>(y * 96 + x)] *
                   (patch ? 1.0F + amplitude * phase : 1.0F);
        });
        const auto result = compared.next(steady, shown, gaze, 1.0 / 90.0).value();
        sum += frame < kFrames / 2
                   ? 0.0
                   : result.mechanisms[static_cast<std::size_t>(Mechanism::Transient)];
    }
    return sum / (kFrames / 2);
}

TEST(FoveatedContrast, SeesFlicker) {
    double before = 0.0;
    for (const float amplitude : {0.01F, 0.03F, 0.1F, 0.3F}) {
        const double seen = flicker(6.0, amplitude);
        EXPECT_GT(seen, before) << amplitude;
        before = seen;
    }
    EXPECT_GT(flicker(6.0, 0.1F), 1.5 * flicker(20.0, 0.1F));
    EXPECT_GT(flicker(20.0, 0.1F), 2.0 * flicker(40.0, 0.1F));
    EXPECT_GT(flicker(6.0, 0.1F), 1.5 * flicker(6.0, 0.1F, looking(25.0)));
}

TEST(FoveatedContrast, ForgetsWhenAsked) {
    const auto a = textured_picture(64, 64);
    const auto b = grey_picture(64, 64, 0.9F);
    auto compared = metric(flat_view(64, 64, 25.0));
    const double first = compared.next(a, a, kAhead, 0.01)->value;
    EXPECT_EQ(first, 0.0);
    const double after = compared.next(a, b, kAhead, 0.01)->value;
    compared.forget();
    const double fresh = compared.next(a, b, kAhead, 0.01)->value;
    EXPECT_GT(fresh, 0.0);
    EXPECT_NE(after, fresh);
    EXPECT_NEAR(fresh, compared.still(a, b, kAhead)->value, 1e-4 * fresh);
}

TEST(FoveatedContrast, StaysFiniteForAbsurdLight) {
    const auto black = grey_picture(33, 33, 0.0F);
    for (const float light : {-1e6F, 1e-30F, 1.0F, 1e6F}) {
        for (const double black_cd_m2 : {0.0, 0.1}) {
            auto compared =
                FoveatedContrast::create(flat_view(33, 33, 25.0), gaze::Eye::Right,
                                         {.light = {.peak_cd_m2 = 1e4, .black_cd_m2 = black_cd_m2}})
                    .value();
            auto dotted = black;
            dotted.pixels[500] = glm::vec3(light, 0.0F, light);
            const auto result = compared.still(black, dotted, kAhead, true).value();
            EXPECT_TRUE(std::isfinite(result.value)) << light;
            EXPECT_GE(result.value, 0.0);
        }
    }
}

TEST(FoveatedContrast, RefusesWhatCannotBeCompared) {
    const gaze::EyeView view = flat_view(32, 32, 25.0);
    auto compared = metric(view);
    const auto good = textured_picture(32, 32);
    const auto refusal = [](const auto& result) {
        return result ? std::string() : result.error().message;
    };
    EXPECT_NE(refusal(compared.still(good, textured_picture(32, 31), kAhead)).find("32x31"),
              std::string::npos);
    EXPECT_NE(refusal(compared.still(textured_picture(8, 8), textured_picture(8, 8), kAhead)), "");
    auto bad = good;
    bad.pixels[70].y = std::numeric_limits<float>::quiet_NaN();
    bad.pixels[71].x = std::numeric_limits<float>::infinity();
    bad.pixels[72].z = -1e30F;
    EXPECT_NE(refusal(compared.still(good, bad, kAhead))
                  .find("3 of 1024 pixels are not finite or over 1e+06, the first at 6,2"),
              std::string::npos);
    EXPECT_NE(refusal(compared.still({}, {}, kAhead)), "");
    EXPECT_NE(refusal(compared.still(good, good, {0.0, 0.0, 0.0})), "");
    EXPECT_NE(refusal(compared.still(good, good, {std::nan(""), 0.0, -1.0})), "");
    for (const double seconds : {0.0, -1.0, 11.0, std::nan("")}) {
        EXPECT_NE(refusal(compared.next(good, good, kAhead, seconds)), "") << seconds;
    }
    const auto create = [&](const gaze::EyeView& asked, DisplayLight light) {
        return FoveatedContrast::create(asked, gaze::Eye::Left, {.light = light}).has_value();
    };
    EXPECT_FALSE(create(gaze::EyeView{}, {}));
    EXPECT_FALSE(create(view, {.peak_cd_m2 = 0.0}));
    EXPECT_FALSE(create(view, {.peak_cd_m2 = std::nan("")}));
    EXPECT_FALSE(create(view, {.peak_cd_m2 = 10.0, .black_cd_m2 = 11.0}));
    EXPECT_FALSE(create(view, {.peak_cd_m2 = 10.0, .black_cd_m2 = -1.0}));
    EXPECT_TRUE(create(view, {.peak_cd_m2 = 10.0, .black_cd_m2 = 10.0}));
}

}  // namespace
}  // namespace gazeloop::quality
