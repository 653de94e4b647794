// The double-precision maps, which everything else is measured against, against 200 bits.
#include <gtest/gtest.h>
#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "runtime/foveation/log_polar/acuity_profile.h"
#include "runtime/foveation/log_polar/log_polar_map.h"

namespace gazeloop::foveation {
namespace {

class Wide {
  public:
    Wide() { mpfr_init2(value_, 200); }
    explicit Wide(double value) : Wide() { mpfr_set_d(value_, value, MPFR_RNDN); }
    Wide(const Wide&) = delete;
    Wide& operator=(const Wide&) = delete;
    ~Wide() { mpfr_clear(value_); }

    mpfr_ptr operator*() { return value_; }
    [[nodiscard]] double rounded() const { return mpfr_get_d(value_, MPFR_RNDN); }

  private:
    mpfr_t value_;
};

/// u = (ln r / ln rmax)^alpha with r = |position - fovea|.
double u_power(double dx, double dy, double far_x, double far_y, double alpha) {
    Wide r;
    Wide far;
    Wide power(alpha);
    mpfr_hypot(*r, *Wide(dx), *Wide(dy), MPFR_RNDN);
    mpfr_hypot(*far, *Wide(far_x), *Wide(far_y), MPFR_RNDN);
    mpfr_log(*r, *r, MPFR_RNDN);
    mpfr_log(*far, *far, MPFR_RNDN);
    mpfr_div(*r, *r, *far, MPFR_RNDN);
    mpfr_pow(*r, *r, *power, MPFR_RNDN);
    return r.rounded();
}

/// r = rmax^(u^(1/alpha))
double radius_power(double u, double far_x, double far_y, double alpha) {
    Wide r(u);
    Wide far;
    Wide power(1.0);
    mpfr_div(*power, *power, *Wide(alpha), MPFR_RNDN);
    mpfr_hypot(*far, *Wide(far_x), *Wide(far_y), MPFR_RNDN);
    mpfr_pow(*r, *r, *power, MPFR_RNDN);
    mpfr_pow(*r, *far, *r, MPFR_RNDN);
    return r.rounded();
}

// 1e-9 px at 16384 px: a millionth of the least error that floats make.
TEST(Doubles, HoldTheKernelMapToANanopixel) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (const double alpha : {0.25, 0.5, 1.0, 4.0, 8.0, 16.0}) {
        for (const double fovea_x : {8192.0, 0.0, -32768.0}) {
            const LogPolarMap map(alpha, {16384, 16384}, {fovea_x, 100.0});
            const double far_x = std::max(std::abs(fovea_x), 16384.0 - fovea_x);
            const double far_y = 16284.0;
            for (int i = 0; i < 200; ++i) {
                const double dx = unit(random) * far_x;
                const double dy = unit(random) * far_y;
                const double r = std::hypot(dx, dy);
                const double u = u_power(dx, dy, far_x, far_y, alpha);
                EXPECT_NEAR(map.u(r), u, 1e-14 * (1.0 + alpha)) << alpha << ' ' << r;
                const double share = unit(random);
                EXPECT_NEAR(map.radius_px(share), radius_power(share, far_x, far_y, alpha), 1e-9)
                    << alpha << ' ' << share;
            }
        }
    }
}

TEST(Doubles, HoldTheAcuityProfile) {
    const gaze::EyeView view{.fov = {-0.9, 0.9, 0.9, -0.9}, .width_px = 2000, .height_px = 2000};
    for (const double slope : {0.001, 0.022, 0.5}) {
        const AcuityProfile profile = value_or_throw(
            AcuityProfile::create({.mar = {.slope = slope}, .pixels_per_degree = 15.8}, view));
        Wide limit(2.0);
        mpfr_div(*limit, *limit, *Wide(15.8), MPFR_RNDN);
        Wide omega;
        mpfr_set(*omega, *limit, MPFR_RNDN);
        mpfr_sub(*limit, *limit, *Wide(1.0 / 48.0), MPFR_RNDN);
        mpfr_div(*limit, *limit, *Wide(slope), MPFR_RNDN);
        for (double e = 0.01; e < 179.0; e *= 1.1) {
            if (e <= profile.display_limit_deg()) {
                continue;
            }
            // p e_c + (2 / m) ln[(omega0 + m e) / (2 / p)]
            Wide columns(e);
            mpfr_mul(*columns, *columns, *Wide(slope), MPFR_RNDN);
            mpfr_add(*columns, *columns, *Wide(1.0 / 48.0), MPFR_RNDN);
            mpfr_div(*columns, *columns, *omega, MPFR_RNDN);
            mpfr_log(*columns, *columns, MPFR_RNDN);
            mpfr_mul(*columns, *columns, *Wide(2.0), MPFR_RNDN);
            mpfr_div(*columns, *columns, *Wide(slope), MPFR_RNDN);
            Wide inner;
            mpfr_mul(*inner, *limit, *Wide(15.8), MPFR_RNDN);
            mpfr_add(*columns, *columns, *inner, MPFR_RNDN);
            EXPECT_NEAR(profile.columns(e) / columns.rounded(), 1.0, 1e-13) << slope << ' ' << e;
        }
    }
}

}  // namespace
}  // namespace gazeloop::foveation
