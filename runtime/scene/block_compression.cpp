#include "runtime/scene/block_compression.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace gazeloop::scene {
namespace {

constexpr std::uint32_t kSide = 4;
constexpr std::uint32_t kTexels = kSide * kSide;

using Block = std::array<glm::vec3, kTexels>;  ///< codes, 0 to 255

/// 5, 6 and 5 bits.
std::uint16_t packed(const glm::vec3& code) {
    const auto bits = [](float value, int most) {
        return static_cast<std::uint16_t>(
            std::lround(std::clamp(value, 0.0F, 255.0F) / 255.0F * static_cast<float>(most)));
    };
    return static_cast<std::uint16_t>(bits(code.x, 31) << 11U | bits(code.y, 63) << 5U |
                                      bits(code.z, 31));
}

/// As decoders widen it: the high bits again below the low ones.
glm::vec3 widened(std::uint16_t colour) {
    const std::uint32_t r = colour >> 11U;
    const std::uint32_t g = colour >> 5U & 63U;
    const std::uint32_t b = colour & 31U;
    return {static_cast<float>(r << 3U | r >> 2U), static_cast<float>(g << 2U | g >> 4U),
            static_cast<float>(b << 3U | b >> 2U)};
}

struct Encoded {
    std::uint16_t first = 0;   ///< the greater number: four colours
    std::uint16_t second = 0;  ///< equal: all texels are the first
    std::uint32_t indices = 0;
    float error = std::numeric_limits<float>::max();
};

/// The nearest of the colours that two ends give, for each texel.
Encoded encoded(const Block& block, const glm::vec3& a, const glm::vec3& b) {
    Encoded made{.first = packed(a), .second = packed(b), .error = 0.0F};
    if (made.first < made.second) {
        std::swap(made.first, made.second);
    }
    const glm::vec3 from = widened(made.first);
    const glm::vec3 to = widened(made.second);
    const std::array palette{from, to, (2.0F * from + to) / 3.0F, (from + 2.0F * to) / 3.0F};
    const std::uint32_t colours = made.first == made.second ? 1 : 4;
    for (std::uint32_t i = 0; i < kTexels; ++i) {
        float least = std::numeric_limits<float>::max();
        std::uint32_t nearest = 0;
        for (std::uint32_t c = 0; c < colours; ++c) {
            const glm::vec3 apart = palette[c] - block[i];
            const float error = glm::dot(apart, apart);
            if (error < least) {
                least = error;
                nearest = c;
            }
        }
        made.error += least;
        made.indices |= nearest << (2 * i);
    }
    return made;
}

/// The ends that fit the texels best, each where its index puts it between them.
Encoded refined(const Block& block, const Encoded& before) {
    constexpr std::array kShareOfSecond{0.0F, 1.0F, 1.0F / 3.0F, 2.0F / 3.0F};
    float aa = 0.0F;
    float ab = 0.0F;
    float bb = 0.0F;
    glm::vec3 ax(0.0F);
    glm::vec3 bx(0.0F);
    for (std::uint32_t i = 0; i < kTexels; ++i) {
        const float b = kShareOfSecond[before.indices >> (2 * i) & 3U];
        const float a = 1.0F - b;
        aa += a * a;
        ab += a * b;
        bb += b * b;
        ax += a * block[i];
        bx += b * block[i];
    }
    const float determinant = aa * bb - ab * ab;
    if (determinant < 1e-3F) {
        return before;  // all at one place: there is no line to fit
    }
    const Encoded after =
        encoded(block, (bb * ax - ab * bx) / determinant, (aa * bx - ab * ax) / determinant);
    return after.error < before.error ? after : before;
}

/// The ends of the block's principal axis.
Encoded along_principal_axis(const Block& block) {
    glm::vec3 mean(0.0F);
    for (const glm::vec3& texel : block) {
        mean += texel / static_cast<float>(kTexels);
    }
    glm::mat3 spread(0.0F);
    for (const glm::vec3& texel : block) {
        spread += glm::outerProduct(texel - mean, texel - mean);
    }
    // Not across the axis, whichever it is, but where all its colours are alike.
    glm::vec3 axis = spread[0];
    for (int column = 1; column < 3; ++column) {
        axis =
            glm::dot(spread[column], spread[column]) > glm::dot(axis, axis) ? spread[column] : axis;
    }
    constexpr int kPowers = 6;
    for (int power = 0; power < kPowers && glm::dot(axis, axis) > 1e-12F; ++power) {
        axis = spread * glm::normalize(axis);
    }
    axis = glm::dot(axis, axis) > 1e-12F ? glm::normalize(axis) : glm::vec3(0.0F);
    float least = 0.0F;
    float greatest = 0.0F;
    for (const glm::vec3& texel : block) {
        const float along = glm::dot(texel - mean, axis);
        least = std::min(least, along);
        greatest = std::max(greatest, along);
    }
    return encoded(block, mean + greatest * axis, mean + least * axis);
}

}  // namespace

std::vector<std::byte> compress_bc1(std::span<const std::byte> rgba, std::uint32_t width_px,
                                    std::uint32_t height_px) {
    std::vector<std::byte> out;
    out.reserve(bc1_bytes(width_px, height_px));
    const auto put = [&](std::uint32_t value, int bytes) {
        for (int i = 0; i < bytes; ++i) {
            out.push_back(static_cast<std::byte>(value >> (8 * i) & 0xffU));
        }
    };
    for (std::uint32_t top = 0; top < height_px; top += kSide) {
        for (std::uint32_t left = 0; left < width_px; left += kSide) {
            Block block;
            for (std::uint32_t i = 0; i < kTexels; ++i) {
                // Beyond the picture's edge, its last texels again.
                const std::uint32_t x = std::min(left + i % kSide, width_px - 1);
                const std::uint32_t y = std::min(top + i / kSide, height_px - 1);
                const std::span texel = rgba.subspan(4 * (std::size_t{y} * width_px + x), 3);
                for (int c = 0; c < 3; ++c) {
                    block[i][c] = static_cast<float>(
                        std::to_integer<int>(texel[static_cast<std::size_t>(c)]));
                }
            }
            Encoded best = along_principal_axis(block);
            best = refined(block, refined(block, best));
            put(best.first, 2);
            put(best.second, 2);
            put(best.indices, 4);
        }
    }
    return out;
}

}  // namespace gazeloop::scene
