#include "runtime/scene/mesh/mip_chain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace gazeloop::scene::mesh {
namespace {

constexpr std::size_t kChannels = 4;

float light_of(float code) {
    return code <= 0.04045F ? code / 12.92F : std::pow((code + 0.055F) / 1.055F, 2.4F);
}

float code_of(float light) {
    return light <= 0.0031308F ? 12.92F * light : 1.055F * std::pow(light, 1.0F / 2.4F) - 0.055F;
}

/// Rows of one level as linear values.
struct Values {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<float> at;
};

Values values_of(const Image& image) {
    Values values{image.width, image.height, {}};
    const std::size_t count = std::size_t{kChannels} * image.width * image.height;
    values.at.resize(count);
    const bool srgb = image.color_space == ColorSpace::Srgb;
    if (image.format == TexelFormat::Rgba8) {
        std::array<float, 256> light{};
        for (std::size_t code = 0; code < light.size(); ++code) {
            light.at(code) = light_of(static_cast<float>(code) / 255.0F);
        }
        for (std::size_t i = 0; i < count; ++i) {
            const auto code = std::to_integer<std::size_t>(image.texels[i]);
            values.at[i] =
                srgb && i % kChannels != 3 ? light.at(code) : static_cast<float>(code) / 255.0F;
        }
        return values;
    }
    for (std::size_t i = 0; i < count; ++i) {
        std::uint16_t code = 0;
        std::memcpy(&code, image.texels.data() + 2 * i, sizeof code);
        const float value = static_cast<float>(code) / 65535.0F;
        values.at[i] = srgb && i % kChannels != 3 ? light_of(value) : value;
    }
    return values;
}

/// A texel's share of the level above along one axis: first texel, and the weights of up to three.
struct Cover {
    std::uint32_t first;
    std::array<float, 3> weights;
};

Cover cover_of(std::uint32_t texel, std::uint32_t size, std::uint32_t above) {
    const double scale = static_cast<double>(above) / size;
    const double low = texel * scale;
    const double high = low + scale;
    const auto first = static_cast<std::uint32_t>(low);
    Cover cover{first, {}};
    for (std::uint32_t i = 0; i < cover.weights.size(); ++i) {
        const double from = std::max(low, static_cast<double>(first + i));
        const double to = std::min(high, static_cast<double>(first + i + 1));
        cover.weights.at(i) = static_cast<float>(std::max(0.0, to - from) / scale);
    }
    return cover;
}

Values halved(const Values& above) {
    Values level{std::max(1U, above.width / 2), std::max(1U, above.height / 2), {}};
    level.at.resize(std::size_t{kChannels} * level.width * level.height);
    for (std::uint32_t y = 0; y < level.height; ++y) {
        const Cover rows = cover_of(y, level.height, above.height);
        for (std::uint32_t x = 0; x < level.width; ++x) {
            const Cover columns = cover_of(x, level.width, above.width);
            std::array<float, kChannels> sum{};
            for (std::uint32_t dy = 0; dy < 3; ++dy) {
                for (std::uint32_t dx = 0; dx < 3; ++dx) {
                    const float weight = rows.weights.at(dy) * columns.weights.at(dx);
                    if (weight == 0.0F) {
                        continue;
                    }
                    const std::uint32_t row = std::min(rows.first + dy, above.height - 1);
                    const std::uint32_t column = std::min(columns.first + dx, above.width - 1);
                    const float* texel =
                        &above.at[kChannels * (std::size_t{row} * above.width + column)];
                    for (std::size_t c = 0; c < kChannels; ++c) {
                        sum.at(c) += weight * texel[c];
                    }
                }
            }
            std::ranges::copy(
                sum, level.at.begin() + static_cast<std::ptrdiff_t>(
                                            kChannels * (std::size_t{y} * level.width + x)));
        }
    }
    return level;
}

MipLevel coded(const Values& values, const Image& like) {
    MipLevel level{values.width, values.height, {}};
    const bool srgb = like.color_space == ColorSpace::Srgb;
    const bool bytes = like.format == TexelFormat::Rgba8;
    level.texels.resize(values.at.size() * (bytes ? 1 : 2));
    for (std::size_t i = 0; i < values.at.size(); ++i) {
        const float value = srgb && i % kChannels != 3 ? code_of(values.at[i]) : values.at[i];
        const float most = bytes ? 255.0F : 65535.0F;
        const auto code =
            static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * most));
        if (bytes) {
            level.texels[i] = static_cast<std::byte>(code);
        } else {
            std::memcpy(level.texels.data() + 2 * i, &code, sizeof code);
        }
    }
    return level;
}

}  // namespace

std::vector<MipLevel> smaller_levels(const Image& image) {
    std::vector<MipLevel> levels;
    Values values = values_of(image);
    while (values.width > 1 || values.height > 1) {
        values = halved(values);
        levels.push_back(coded(values, image));
    }
    return levels;
}

Image as_light(const Image& image) {
    Image light = image;
    light.color_space = ColorSpace::Linear;
    light.texels = coded(values_of(image), light).texels;
    return light;
}

}  // namespace gazeloop::scene::mesh
