#include "runtime/quality/encoded_colour.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "runtime/render/srgb.h"

namespace gazeloop::quality {
namespace {

/// The curve at steps that are fine where it is steep: over the square root of its argument.
class EncodingTable {
  public:
    EncodingTable() {
        for (std::size_t at = 0; at < kSteps + 2; ++at) {
            const double root = static_cast<double>(at) / kSteps;
            values_[at] = static_cast<float>(render::srgb_encoded(root * root));
        }
    }
    /// Within 1e-6 of the curve.
    [[nodiscard]] float operator()(float linear) const {
        const float at = std::sqrt(std::clamp(linear, 0.0F, 1.0F)) * static_cast<float>(kSteps);
        const auto below = static_cast<std::size_t>(at);
        return values_[below] +
               (at - static_cast<float>(below)) * (values_[below + 1] - values_[below]);
    }

  private:
    static constexpr std::size_t kSteps = 4096;
    std::array<float, kSteps + 2> values_{};
};

}  // namespace

std::array<Plane, 3> encoded_channels(const render::LinearPicture& picture, const RowWork& work) {
    static const EncodingTable kEncoded;
    std::array<Plane, 3> channels{Plane(picture.width, picture.height),
                                  Plane(picture.width, picture.height),
                                  Plane(picture.width, picture.height)};
    work.over(picture.height, [&](std::uint32_t from, std::uint32_t to) {
        for (std::size_t at = std::size_t{from} * picture.width;
             at < std::size_t{to} * picture.width; ++at) {
            for (int c = 0; c < 3; ++c) {
                channels[static_cast<std::size_t>(c)].values[at] = kEncoded(picture.pixels[at][c]);
            }
        }
    });
    return channels;
}

}  // namespace gazeloop::quality
