#!/usr/bin/env bash
# cairo 1.16.0 (Debian 12's libcairo2): tilt a level edge by a hundredth of a pixel, and its places within
# a pixel fall from 256 to 16, at the best antialiasing too; an upright edge keeps them.
#
# Shapes whose edges all lie along the axes are drawn by their exact areas. Any other shape is cut into 15
# rows in a pixel's height, but 256 columns in its width: a level edge of it moves in steps of 1/15 pixel
# (up to 0.033 of full contrast off), an upright one in steps of 1/256. CAIRO_ANTIALIAS_BEST ("the highest
# quality"), GOOD, GRAY and the default are the same here; FAST has 4 or 5 places both ways. The documentation
# leaves quality to the backend; that it has a direction, or that a tilt of 0.02 degrees costs it, it
# does not say. So a vernier target or a slanted edge (as for sharpness) that cairo drew is displaced by
# steps of its own, and turned by 90 degrees it is another one.
# Draw such a target 16 times as large and average it down, or compute its areas oneself.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
cd -- "$folder"
apt-get download -q libcairo2=1.16.0-7 libcairo2-dev=1.16.0-7 libpixman-1-0=0.42.2-1 \
    libfontconfig1=2.14.1-4 libfreetype6=2.12.1+dfsg-5+deb12u4 libpng16-16=1.6.39-2+deb12u6 \
    libexpat1=2.5.0-1+deb12u5 libbrotli1=1.0.9-2+deb12u1 libx11-6=2:1.8.4-2+deb12u2 \
    libxext6=2:1.3.4-1+b1 libxrender1=1:0.9.10-1.1 libxcb1=1.15-1 libxcb-shm0=1.15-1 \
    libxcb-render0=1.15-1 libxau6=1:1.0.9-1 libxdmcp6=1:1.1.2-3 libbsd0=0.11.7-2 libmd0=1.0.4-2 \
    >/dev/null 2>&1
for package in ./*.deb; do
    dpkg-deb -x "$package" root
done
library=$folder/root/usr/lib/x86_64-linux-gnu
export LD_LIBRARY_PATH=$library:$folder/root/lib/x86_64-linux-gnu

cat >edge.c <<'CODE'
#include <cairo.h>
#include <math.h>
#include <stdio.h>

enum { kSide = 32, kPlaces = 256 };

struct Edge {
    int levels;   /* how many values the pixel under the edge takes while the edge crosses it */
    double error; /* the largest difference of that value to the area, of full contrast */
};

/* An edge that is shifted over the pixel amid a picture, and rises by `tilt` pixels over its length. */
static struct Edge edge(cairo_antialias_t antialias, int is_upright, double tilt) {
    struct Edge found = {0, 0};
    int seen[256] = {0};
    for (int place = 0; place <= kPlaces; ++place) {
        cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_A8, kSide, kSide);
        cairo_t* draw = cairo_create(surface);
        if (!is_upright) { /* the same shape, mirrored at the diagonal */
            const cairo_matrix_t mirrored = {0, 1, 1, 0, 0, 0};
            cairo_set_matrix(draw, &mirrored);
        }
        cairo_set_antialias(draw, antialias);
        const double at = 10 + (double)place / kPlaces;
        cairo_move_to(draw, at - tilt / 2, 0);
        cairo_line_to(draw, at + tilt / 2, kSide);
        cairo_line_to(draw, kSide, kSide);
        cairo_line_to(draw, kSide, 0);
        cairo_close_path(draw);
        cairo_fill(draw);
        cairo_surface_flush(surface);
        const int row = is_upright ? kSide / 2 : 10;
        const int column = is_upright ? 10 : kSide / 2;
        const int value = cairo_image_surface_get_data(
            surface)[row * cairo_image_surface_get_stride(surface) + column];
        found.levels += seen[value]++ == 0;
        found.error = fmax(found.error, fabs(value / 255.0 - (1 - (double)place / kPlaces)));
        cairo_destroy(draw);
        cairo_surface_destroy(surface);
    }
    return found;
}

int main(void) {
    const struct {
        const char* name;
        cairo_antialias_t antialias;
    } kinds[] = {{"default", CAIRO_ANTIALIAS_DEFAULT},
                 {"good", CAIRO_ANTIALIAS_GOOD},
                 {"best", CAIRO_ANTIALIAS_BEST},
                 {"fast", CAIRO_ANTIALIAS_FAST}};
    int unexpected = 0;
    printf("cairo %s: values of the pixel that an edge crosses in 256 steps (largest error)\n",
           cairo_version_string());
    for (int i = 0; i < 4; ++i) {
        for (int tilted = 0; tilted < 2; ++tilted) {
            const struct Edge upright = edge(kinds[i].antialias, 1, tilted * .01);
            const struct Edge level = edge(kinds[i].antialias, 0, tilted * .01);
            printf("%-8s tilt %.2f px   upright %3d (%.3f)   level %3d (%.3f)\n", kinds[i].name,
                   tilted * .01, upright.levels, upright.error, level.levels, level.error);
            const int is_fast = tilted && kinds[i].antialias == CAIRO_ANTIALIAS_FAST;
            const int is_upright_fine = upright.levels == 256 && upright.error < .005;
            const int is_level_fine = level.levels == 256 && level.error < .005;
            unexpected += is_fast ? upright.levels > 5 : !is_upright_fine;
            unexpected += tilted ? level.levels > 16 || level.error < .03 : !is_level_fine;
        }
    }
    puts(unexpected == 0 ? "as stated" : "NOT as stated: this finding is out of date");
    return unexpected == 0 ? 0 : 1;
}
CODE
gcc -O1 edge.c -Iroot/usr/include/cairo "$library/libcairo.so.2" -Wl,--allow-shlib-undefined -lm -o edge
./edge
