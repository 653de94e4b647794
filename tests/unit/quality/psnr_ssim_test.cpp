#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "runtime/quality/acuity_weights.h"
#include "runtime/quality/encoded_colour.h"
#include "runtime/quality/psnr.h"
#include "runtime/quality/ssim.h"
#include "tests/unit/quality/made_pictures.h"

namespace gazeloop::quality {
namespace {

using tests::box_blurred;
using tests::flat_view;
using tests::grey_picture;
using tests::looking;
using tests::made_picture;
using tests::textured_picture;

const RowWork kWork(2);

Plane weights_of(std::uint32_t side, const glm::dvec3& gaze) {
    const auto field = foveation::GazeField::create(flat_view(side, side, 40.0), gaze).value();
    return acuity_weights(field, foveation::MarLine{}, kWork);
}

double sum(const Plane& plane) {
    return std::accumulate(plane.values.begin(), plane.values.end(), 0.0);
}

TEST(EncodedColour, FollowsTheCurve) {
    const auto ramp = made_picture(
        2001, 1, [](int x, int) { return glm::vec3(static_cast<float>(x) / 1000.0F - 0.5F); });
    const auto channels = encoded_channels(ramp, kWork);
    for (std::size_t at = 0; at < ramp.pixels.size(); ++at) {
        EXPECT_NEAR(channels[1].values[at],
                    render::srgb_encoded(static_cast<double>(ramp.pixels[at].y)), 1e-6);
    }
}

TEST(AcuityWeights, AreTheCyclesThatTheLineResolves) {
    const Plane weights = weights_of(65, looking(0.0));
    EXPECT_NEAR(sum(weights), 1.0, 1e-5);
    // The middle pixel against the one at the right edge, by hand: 40 degrees is the picture's
    // edge, so the outermost centre lies at a tangent of tan(40) 64/65.
    const double tangent = std::tan(glm::radians(40.0)) * 64.0 / 65.0;
    const double e_deg = glm::degrees(std::atan(tangent));
    const double omega_ratio = (0.022 * e_deg + 1.0 / 48.0) / (1.0 / 48.0);
    const double solid_angle_ratio = std::pow(1.0 + tangent * tangent, 1.5);
    EXPECT_NEAR(static_cast<double>(weights.row(32)[32] / weights.row(32)[64]),
                omega_ratio * omega_ratio * solid_angle_ratio, 0.01);
}

TEST(AcuityWeights, FollowTheGaze) {
    const Plane weights = weights_of(65, looking(40.0));
    for (std::uint32_t x = 1; x < 65; ++x) {
        EXPECT_GT(weights.row(32)[x], weights.row(32)[x - 1]);
    }
    const Plane behind = weights_of(65, {0.0, 0.0, 1.0});
    EXPECT_NEAR(sum(behind), 1.0, 1e-5);
}

TEST(Psnr, IsTheMeanSquaredErrorOfCodes) {
    const auto of_code = [](int code) {
        return made_picture(20, 10, [=](int, int) {
            const auto c = static_cast<std::uint8_t>(code);
            return render::linear_of({c, c, c});
        });
    };
    const Plane equal = equal_weights(20, 10);
    EXPECT_NEAR(psnr_db(of_code(100), of_code(110), equal, kWork), 20.0 * std::log10(255.0 / 10.0),
                1e-3);
    EXPECT_NEAR(psnr_db(of_code(0), of_code(255), equal, kWork), 0.0, 1e-4);
    EXPECT_EQ(psnr_db(of_code(7), of_code(7), equal, kWork),
              std::numeric_limits<double>::infinity());
    // One channel of three.
    const auto red =
        made_picture(20, 10, [](int, int) { return render::linear_of({110, 100, 100}); });
    EXPECT_NEAR(psnr_db(of_code(100), red, equal, kWork),
                20.0 * std::log10(255.0 / 10.0) + 10.0 * std::log10(3.0), 1e-3);
}

TEST(Psnr, CountsWhatTheEyeResolves) {
    const auto black = grey_picture(65, 65, 0.0F);
    const auto dot_at = [&](std::size_t x) {
        auto picture = black;
        picture.pixels[32 * 65 + x] = glm::vec3(1.0F);
        return picture;
    };
    const Plane weights = weights_of(65, looking(0.0));
    double before = psnr_db(black, dot_at(32), weights, kWork);
    for (const std::size_t x : {34U, 40U, 50U, 64U}) {
        const double further = psnr_db(black, dot_at(x), weights, kWork);
        EXPECT_GT(further, before + 0.5) << x;
        before = further;
    }
}

double ssim(const render::LinearPicture& a, const render::LinearPicture& b, const Plane& weights,
            const RowWork& work = kWork) {
    return mean_ssim(ssim_map(a, b, work).value(), weights);
}

/// SSIM as its paper writes it, pixel by pixel and in double precision.
double plain_ssim(const render::LinearPicture& a, const render::LinearPicture& b) {
    const auto luma = [](const render::LinearPicture& picture, int x, int y) {
        const glm::vec3& p =
            picture
                .pixels[static_cast<std::size_t>(y) * picture.width + static_cast<std::size_t>(x)];
        return 0.2126 * render::srgb_encoded(static_cast<double>(p.x)) +
               0.7152 * render::srgb_encoded(static_cast<double>(p.y)) +
               0.0722 * render::srgb_encoded(static_cast<double>(p.z));
    };
    double total = 0.0;
    int count = 0;
    for (int y = 5; y + 5 < static_cast<int>(a.height); ++y) {
        for (int x = 5; x + 5 < static_cast<int>(a.width); ++x) {
            double weight_sum = 0.0;
            double mean_a = 0.0;
            double mean_b = 0.0;
            const auto each = [&](const auto& visit) {
                for (int j = -5; j <= 5; ++j) {
                    for (int i = -5; i <= 5; ++i) {
                        visit(std::exp(-(i * i + j * j) / 4.5), luma(a, x + i, y + j),
                              luma(b, x + i, y + j));
                    }
                }
            };
            each([&](double w, double va, double vb) {
                weight_sum += w;
                mean_a += w * va;
                mean_b += w * vb;
            });
            mean_a /= weight_sum;
            mean_b /= weight_sum;
            double var_a = 0.0;
            double var_b = 0.0;
            double cov = 0.0;
            each([&](double w, double va, double vb) {
                var_a += w / weight_sum * (va - mean_a) * (va - mean_a);
                var_b += w / weight_sum * (vb - mean_b) * (vb - mean_b);
                cov += w / weight_sum * (va - mean_a) * (vb - mean_b);
            });
            total += (2 * mean_a * mean_b + 1e-4) * (2 * cov + 9e-4) /
                     ((mean_a * mean_a + mean_b * mean_b + 1e-4) * (var_a + var_b + 9e-4));
            ++count;
        }
    }
    return total / count;
}

TEST(Ssim, IsThePapers) {
    const auto a = textured_picture(40, 33);
    const Plane equal = equal_weights(40, 33);
    for (const auto& b :
         {box_blurred(a, 1), textured_picture(40, 33, 2), grey_picture(40, 33, 0)}) {
        EXPECT_NEAR(ssim(a, b, equal), plain_ssim(a, b), 2e-5);
        EXPECT_EQ(ssim(a, b, equal, RowWork(1)), ssim(b, a, equal, RowWork(4)));
    }
    EXPECT_EQ(ssim(a, a, equal), 1.0);
}

TEST(Ssim, CountsWhatTheEyeResolves) {
    const auto clean = textured_picture(129, 129);
    const auto spoilt_at = [&](int middle) {
        auto picture = clean;
        for (int y = 60; y < 70; ++y) {
            for (int x = middle - 5; x < middle + 5; ++x) {
                picture.pixels[static_cast<std::size_t>(y * 129 + x)] = glm::vec3(0.3F);
            }
        }
        return picture;
    };
    const Plane weights = weights_of(129, looking(0.0));
    const double near = ssim(clean, spoilt_at(64), weights);
    const double far = ssim(clean, spoilt_at(115), weights);
    EXPECT_LT(near, far - 0.01);
}

TEST(Ssim, RefusesPicturesSmallerThanItsWindow) {
    const auto map = ssim_map(grey_picture(11, 11, 0.5F), grey_picture(11, 11, 0.5F), kWork);
    ASSERT_TRUE(map);
    EXPECT_EQ(map->values.size(), 1U);
    const auto refused = ssim_map(grey_picture(40, 10, 0.5F), grey_picture(40, 10, 0.5F), kWork);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::BadInput);
}

}  // namespace
}  // namespace gazeloop::quality
