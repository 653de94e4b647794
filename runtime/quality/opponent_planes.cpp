#include "runtime/quality/opponent_planes.h"

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

namespace gazeloop::quality {
namespace {

/// Linear Rec.709 to the channels, such that white has luminance 1 and no colour. The published
/// matrices are written by rows.
glm::mat3 opponent_from_rgb() {
    const glm::dmat3 xyz_from_rgb =
        glm::transpose(glm::dmat3{0.4123908, 0.3575843, 0.1804808, 0.2126390, 0.7151687, 0.0721923,
                                  0.0193308, 0.1191948, 0.9505322});
    const glm::dmat3 xyz_from_lms =
        glm::transpose(glm::dmat3{2.629129278399650, -3.780202391780134, 10.294956387893450,
                                  0.865649062438827, 1.215555811642301, -0.984175688105352,
                                  -0.008886561474676, 0.081612628990755, 51.371024830897888});
    const glm::dmat3 opponent_from_lms =
        glm::transpose(glm::dmat3{1.0, 1.0, 0.0, 1.0, -2.3112, 0.0, -1.0, -1.0, 50.9875});
    glm::dmat3 matrix = opponent_from_lms * glm::inverse(xyz_from_lms) * xyz_from_rgb;
    const glm::dvec3 white = matrix * glm::dvec3(1.0);
    for (int primary = 0; primary < 3; ++primary) {
        glm::dvec3& channels = matrix[primary];
        channels -= glm::dvec3(0.0, white.y, white.z) * (channels.x / white.x);
    }
    return glm::mat3(matrix / white.x);
}

}  // namespace

void opponent_planes(const render::LinearPicture& picture, const DisplayLight& light,
                     const RowWork& work, std::span<Plane, kOpponentChannels> planes) {
    static const glm::mat3 kOpponentFromRgb = opponent_from_rgb();
    const glm::mat3 matrix = static_cast<float>(light.peak_cd_m2) * kOpponentFromRgb;
    const auto black = static_cast<float>(light.black_cd_m2);
    for (Plane& plane : planes) {
        plane.resize(picture.width, picture.height);
    }
    work.over(picture.height, [&](std::uint32_t from, std::uint32_t to) {
        for (std::size_t at = std::size_t{from} * picture.width;
             at < std::size_t{to} * picture.width; ++at) {
            const glm::vec3 colour = matrix * glm::max(picture.pixels[at], 0.0F);
            planes[kLuminance].values[at] = colour.x + black;
            planes[kRedGreen].values[at] = colour.y;
            planes[kYellowViolet].values[at] = colour.z;
        }
    });
}

}  // namespace gazeloop::quality
