#!/usr/bin/env bash
# GLM 0.9.9.8 (Debian 12's libglm-dev): glm::axis() of a small turn is another axis, or no unit vector.
#
# A quaternion of a turn by 0.0004 rad (1.4 arc minutes) about +Y still holds both: glm::angle() gives
# 0.0004. glm::axis() gives +Z. It divides by sqrt(1 - w * w), and in float w is 1 below about 0.0005
# rad. Just above, w has so few steps left that the axis is 0.72 to 1.16 long. In double the same
# happens at 2e-8 rad. So angleAxis(angle(q), axis(q)), which is q for any larger turn, turns an eye's
# small movement or a tracker's drift into a roll about the line of sight. Neither says so.
# Divide the vector part by its own length instead; it is exact there.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
cd -- "$folder"
apt-get download -q libglm-dev=0.9.9.8+ds-6 >/dev/null 2>&1
dpkg-deb -x libglm-dev_*.deb root

cat >axis.cpp <<'CODE'
#include <cmath>
#include <cstdio>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

static int unexpected = 0;

template <typename T>
void expect(const char* type, T turn, T expected_length, bool is_other_axis) {
    const auto q = glm::angleAxis(turn, glm::vec<3, T>(0, 1, 0));
    const auto axis = glm::axis(q);
    std::printf("%-6s turn %.1e about +Y: angle %.3e, axis (%g, %g, %g), %.3f long\n", type,
                double(turn), double(glm::angle(q)), double(axis.x), double(axis.y),
                double(axis.z), double(glm::length(axis)));
    const bool angle_right = std::abs(glm::angle(q) / turn - 1) < T(1e-3);
    const bool as_stated = is_other_axis ? axis.z == T(1) && axis.y == T(0)
                                         : std::abs(glm::length(axis) - expected_length) < T(.01);
    unexpected += angle_right && as_stated ? 0 : 1;
}

int main() {
    expect<float>("float", 1e-2f, 1.0f, false);
    expect<float>("float", 8e-4f, 1.16f, false);
    expect<float>("float", 5e-4f, .724f, false);
    expect<float>("float", 4e-4f, 0.0f, true);
    expect<double>("double", 1e-3, 1.0, false);
    expect<double>("double", 1e-8, 0.0, true);
    std::puts(unexpected == 0 ? "as stated" : "NOT as stated: this finding is out of date");
    return unexpected == 0 ? 0 : 1;
}
CODE
g++ -std=c++17 -O1 -Iroot/usr/include axis.cpp -o axis
./axis
