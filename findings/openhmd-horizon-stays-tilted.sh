#!/usr/bin/env bash
# OpenHMD 0.3.0 (Debian 12's libopenhmd0): a horizon that is 2.8 degrees wrong stays so for ever, and how
# wrong it becomes depends on how often the sensors are read.
#
# OHMD_EXTERNAL_SENSOR_FUSION takes gyroscope and accelerometer with the time between samples, and its own
# drivers of headsets use the same fusion. The accelerometer corrects nothing below .05 radians, 2.86
# degrees: after ten minutes at rest, with gravity exact, all of a tilt of 2.8 degrees is left, and of 20
# degrees 2.86. Above that it takes a share of each sample, not of each second: a gyroscope that is .3
# degrees per second off tilts the world by 2.9 degrees if read at 1000 Hz, by 19.6 at 60 Hz. Even a
# good gyroscope, .02 degrees per second off, comes to rest at 2.9. openhmd.h says "performs sensor fusion".
# Gaze in world coordinates is turned by as much, and who compares two rates compares two filters.
# Take the gyroscope's bias (its mean at rest) out before, or fuse oneself: a high rate only ends at 2.86.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
cd -- "$folder"
apt-get download -q libopenhmd0=0.3.0-1 libopenhmd-dev=0.3.0-1 libhidapi-libusb0=0.13.1-1 \
    libusb-1.0-0=2:1.0.26-1 >/dev/null 2>&1
for package in ./*.deb; do
    dpkg-deb -x "$package" root
done
library=$folder/root/usr/lib/x86_64-linux-gnu
export LD_LIBRARY_PATH=$library:$folder/root/lib/x86_64-linux-gnu

cat >horizon.c <<'CODE'
#include <math.h>
#include <openhmd.h>
#include <stdio.h>
#include <string.h>

static const double kDegree = M_PI / 180;
static const double kGravity = 9.82;

static ohmd_context* context;
static int external = -1;

/* So many seconds of a device that rests with gravity `tilt` degrees off its own upward axis, while its
   gyroscope says so many degrees per second. */
static void rest(ohmd_device* device, int rate, double seconds, double tilt, double gyroscope) {
    const float values[10] = {1.0F / (float)rate,
                              (float)(gyroscope * kDegree),
                              0,
                              0,
                              0,
                              (float)(kGravity * cos(tilt * kDegree)),
                              (float)(kGravity * sin(tilt * kDegree)),
                              0,
                              0,
                              0};
    for (long i = 0; i < lround(seconds * rate); ++i) {
        ohmd_device_setf(device, OHMD_EXTERNAL_SENSOR_FUSION, values);
    }
}

/* The angle in degrees between the true vertical of that device and the one that OpenHMD has. */
static double wrong(ohmd_device* device, double tilt) {
    float q[4];
    ohmd_ctx_update(context);
    ohmd_device_getf(device, OHMD_ROTATION_QUAT, q);
    /* gravity as measured, turned into the world, against the world's upward axis */
    const double y = cos(tilt * kDegree);
    const double z = sin(tilt * kDegree);
    const double up = (1 - 2 * (q[0] * q[0] + q[2] * q[2])) * y + 2 * (q[1] * q[2] - q[0] * q[3]) * z;
    return acos(fmin(1, up)) / kDegree;
}

/* What is left after ten minutes of a tilt that is there after a minute of level rest. */
static double left(int rate, double tilt) {
    ohmd_device* device = ohmd_list_open_device(context, external);
    rest(device, rate, 60, 0, 0);
    rest(device, rate, 600, tilt, 0);
    const double angle = wrong(device, tilt);
    ohmd_close_device(device);
    return angle;
}

/* How far off the horizon is after twenty minutes of level rest by that gyroscope. */
static double drifted(int rate, double gyroscope) {
    ohmd_device* device = ohmd_list_open_device(context, external);
    rest(device, rate, 1200, 0, gyroscope);
    const double angle = wrong(device, 0);
    ohmd_close_device(device);
    return angle;
}

int main(void) {
    context = ohmd_ctx_create();
    const int count = ohmd_ctx_probe(context);
    for (int i = 0; i < count; ++i) {
        if (strcmp(ohmd_list_gets(context, i, OHMD_PRODUCT), "External Device") == 0) external = i;
    }
    if (external < 0) return 2;

    const struct {
        double value;
        double stated[3]; /* of 60, 250 and 1000 Hz */
    } tilts[] = {{1, {1, 1, 1}}, {2.8, {2.8, 2.8, 2.8}}, {5, {2.86, 2.86, 2.86}}, {20, {2.86, 2.86, 2.86}}},
      drifts[] = {{0, {0, 0, 0}},
                  {.02, {2.88, 2.87, 2.86}},
                  {.1, {6.65, 2.88, 2.87}},
                  {.3, {19.61, 4.71, 2.88}}};
    const int rates[] = {60, 250, 1000};
    int unexpected = 0;
    puts("degrees of tilt that OpenHMD has  60 Hz  250 Hz  1000 Hz");
    for (int drift = 0; drift < 2; ++drift) {
        for (int row = 0; row < 4; ++row) {
            const double value = drift ? drifts[row].value : tilts[row].value;
            printf(drift ? "20 minutes, gyroscope %.2f /s off" : "10 minutes after a tilt of %4.1f  ", value);
            for (int i = 0; i < 3; ++i) {
                const double found = drift ? drifted(rates[i], value) : left(rates[i], value);
                printf("  %6.2f", found);
                const double stated = drift ? drifts[row].stated[i] : tilts[row].stated[i];
                unexpected += fabs(found - stated) > .05 ? 1 : 0;
            }
            puts("");
        }
    }
    ohmd_ctx_destroy(context);
    puts(unexpected == 0 ? "as stated" : "NOT as stated: this finding is out of date");
    return unexpected == 0 ? 0 : 1;
}
CODE
gcc -O1 horizon.c -Iroot/usr/include/openhmd "$library/libopenhmd.so.0" -Wl,--allow-shlib-undefined -lm \
    -o horizon
./horizon
