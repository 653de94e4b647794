#!/usr/bin/env bash
# GLM 0.9.9.8 (Debian 12's libglm-dev): its packings for 11-bit and shared-exponent floats, the formats
# of HDR textures (B10G11R11, E5B9G9R9), lose what the formats can hold.
#
# packF2x11_1x10: 1e-6, which is below the least number, comes back as 4288: a tiny radiance becomes a
# bright spot. -1 comes back as +1 (the format has no sign, and OpenGL and Vulkan say 0).
# packF3x9_E1x5: 60000 comes back as 32768, although the format holds up to 65408. packHalf1x16 rounds a tie away from zero: 2049 becomes 2050, where the processor's own
# conversion (round to even) gives 2048, so that pictures packed by both differ by a bit.
# Nothing is said in any of these cases. Convert with a small function of one's own, with a test.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
cd -- "$folder"
apt-get download -q libglm-dev=0.9.9.8+ds-6 >/dev/null 2>&1
dpkg-deb -x libglm-dev_*.deb root

cat >packed.cpp <<'CODE'
#include <cmath>
#include <cstdio>
#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>

static int unexpected = 0;

void expect(const char* format, float in, float out, float stated) {
    std::printf("%-16s %g -> %g\n", format, double(in), double(out));
    unexpected += std::abs(out - stated) <= 1e-3f * std::abs(stated) ? 0 : 1;
}
float f11(float x) { return glm::unpackF2x11_1x10(glm::packF2x11_1x10({x, 0, 0})).x; }
float rgb9e5(float x) { return glm::unpackF3x9_E1x5(glm::packF3x9_E1x5(glm::vec3(x, 0, 0))).x; }
float half(float x) { return glm::unpackHalf1x16(glm::packHalf1x16(x)); }

int main() {
    expect("packF2x11_1x10", 1.0f, f11(1.0f), 1.0f);
    expect("packF2x11_1x10", 1e-6f, f11(1e-6f), 4288.0f);
    expect("packF2x11_1x10", -1.0f, f11(-1.0f), 1.0f);
    expect("packF3x9_E1x5", 30000.0f, rgb9e5(30000.0f), 30016.0f);
    expect("packF3x9_E1x5", 60000.0f, rgb9e5(60000.0f), 32768.0f);
    expect("packHalf1x16", 2049.0f, half(2049.0f), 2050.0f);
    std::puts(unexpected == 0 ? "as stated" : "NOT as stated: this finding is out of date");
    return unexpected == 0 ? 0 : 1;
}
CODE
g++ -std=c++17 -O1 -Iroot/usr/include packed.cpp -o packed
./packed
