#include "runtime/scene/mesh/mip_chain.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#include "runtime/memory/large_pages.h"

namespace gazeloop::scene::mesh {
namespace {

constexpr std::size_t kChannels = 4;

float light_of(float code) {
    return code <= 0.04045F ? code / 12.92F : std::pow((code + 0.055F) / 1.055F, 2.4F);
}

float code_of(float light) {
    return light <= 0.0031308F ? 12.92F * light : 1.055F * std::pow(light, 1.0F / 2.4F) - 0.055F;
}

/// As std::clamp(), which is a jump where this is an instruction.
float within_1(float value) { return std::min(std::max(value, 0.0F), 1.0F); }

constexpr float kMostByte = 255.0F;
constexpr float kMostWord = 65535.0F;

/// The code of a value in [0, 1] times the greatest code, halves upwards. In double, where the half
/// is added exactly; std::lround() is a call for each value.
std::uint16_t rounded(float scaled) {
    // NOLINTNEXTLINE(bugprone-incorrect-roundings)
    return static_cast<std::uint16_t>(static_cast<double>(scaled) + 0.5);
}

/// The same of a code of 8 bits: the fraction of a float is exact, and integers of 32 bits are what
/// a processor rounds four at a time.
std::uint8_t rounded_byte(float scaled) {
    const auto whole = static_cast<std::int32_t>(scaled);
    const std::int32_t up = scaled - static_cast<float>(whole) >= 0.5F ? 1 : 0;
    return static_cast<std::uint8_t>(whole + up);
}

/// sRGB codes of light without a power for each: the float at which each code begins.
class SrgbCodes {
  public:
    SrgbCodes() {
        for (std::uint32_t code = 1; code <= 255; ++code) {
            begins_.at(code) = first_of(code);
        }
        begins_.back() = 2.0F;  // above all light
        std::uint8_t code = 0;
        for (std::size_t i = 0; i < at_.size(); ++i) {
            const float low = static_cast<float>(i) / kCells;
            while (begins_.at(code + 1U) <= low) {
                ++code;
            }
            at_.at(i) = code;
        }
    }

    /// Of light in [0, 1].
    [[nodiscard]] std::uint8_t of(float light) const {
        const std::uint32_t code = at_[static_cast<std::size_t>(light * kCells)];
        return static_cast<std::uint8_t>(code + (begins_[code + 1U] <= light ? 1U : 0U));
    }

  private:
    /// So many that a cell, 1/4096 of white, holds a step at most: at the dark end, where they are
    /// finest, steps are 1/3295.
    static constexpr float kCells = 4096.0F;

    /// The least float that rounds to `code` or above; floats from 0 on are ordered as their bits.
    static float first_of(std::uint32_t code) {
        std::uint32_t below = 0;
        auto at = std::bit_cast<std::uint32_t>(1.0F);
        while (at - below > 1) {
            const std::uint32_t middle = below + (at - below) / 2;
            const float light = std::bit_cast<float>(middle);
            (rounded(std::clamp(code_of(light), 0.0F, 1.0F) * kMostByte) >= code ? at : below) =
                middle;
        }
        return std::bit_cast<float>(at);
    }

    std::array<float, 257> begins_{};
    std::array<std::uint8_t, 4097> at_{};
};

/// Rows of one level as linear values.
struct Values {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    memory::LargePagesVector<float> at;

    [[nodiscard]] std::size_t row_length() const { return kChannels * std::size_t{width}; }
    [[nodiscard]] const float* row(std::uint32_t y) const { return &at[y * row_length()]; }
};

/// An image's rows as linear values. The last four that were asked for stay.
class ImageRows {
  public:
    explicit ImageRows(const Image& image)
        : width(image.width),
          height(image.height),
          image_(&image),
          row_length_(kChannels * std::size_t{image.width}),
          kept_(kKept * row_length_) {
        for (std::size_t code = 0; code < plain_.size(); ++code) {
            plain_.at(code) = static_cast<float>(code) / kMostByte;
            color_.at(code) = light_of(plain_.at(code));
        }
    }

    [[nodiscard]] const float* row(std::uint32_t y) {
        const std::size_t slot = y % kKept;
        float* to = &kept_[slot * row_length_];
        if (rows_.at(slot) != y) {
            rows_.at(slot) = y;
            read(y, to);
        }
        return to;
    }

    void read(std::uint32_t y, float* to) const {
        if (image_->format == TexelFormat::Rgba8) {
            const std::byte* from = image_->texels.data() + y * row_length_;
            if (image_->color_space == ColorSpace::Linear) {
                // A processor divides four at a time, and does not look up so many.
                const auto* const codes = reinterpret_cast<const std::uint8_t*>(from);
                for (std::size_t i = 0; i < row_length_; ++i) {
                    to[i] = static_cast<float>(codes[i]) / kMostByte;
                }
                return;
            }
            for (std::size_t i = 0; i < row_length_; i += kChannels) {
                for (std::size_t c = 0; c < 3; ++c) {
                    to[i + c] = color_[std::to_integer<std::size_t>(from[i + c])];
                }
                to[i + 3] = plain_[std::to_integer<std::size_t>(from[i + 3])];
            }
            return;
        }
        const bool srgb = image_->color_space == ColorSpace::Srgb;
        const std::byte* from = image_->texels.data() + std::size_t{2} * y * row_length_;
        for (std::size_t i = 0; i < row_length_; ++i) {
            std::uint16_t code = 0;
            std::memcpy(&code, from + 2 * i, sizeof code);
            const float value = static_cast<float>(code) / kMostWord;
            to[i] = srgb && i % kChannels != 3 ? light_of(value) : value;
        }
    }

    std::uint32_t width;
    std::uint32_t height;

  private:
    static constexpr std::uint32_t kKept = 4;

    const Image* image_;
    std::size_t row_length_;
    std::array<float, 256> color_{};  ///< of codes of sRGB
    std::array<float, 256> plain_{};
    std::vector<float> kept_;
    std::array<std::uint64_t, kKept> rows_{~0ULL, ~0ULL, ~0ULL, ~0ULL};
};

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

/// One row of a level whose both sides are half of those above: the mean of squares of four.
void halve_row(const float* upper, const float* lower, std::size_t row_length, float* to) {
    constexpr float kQuarter = 0.25F;
    for (std::size_t i = 0; i < row_length; i += kChannels) {
        const std::size_t at = 2 * i;
        for (std::size_t c = 0; c < kChannels; ++c) {
            to[i + c] = kQuarter * upper[at + c] + kQuarter * upper[at + kChannels + c] +
                        kQuarter * lower[at + c] + kQuarter * lower[at + kChannels + c];
        }
    }
}

/// The next level of what has `width`, `height` and row(y), which stays for two more rows.
template <typename Above>
Values halved(Above& above) {
    Values level{std::max(1U, above.width / 2), std::max(1U, above.height / 2), {}};
    level.at.resize(level.row_length() * level.height);
    const bool is_even = above.width == 2 * level.width && above.height == 2 * level.height;
    std::vector<Cover> columns;
    for (std::uint32_t x = 0; !is_even && x < level.width; ++x) {
        columns.push_back(cover_of(x, level.width, above.width));
    }
    for (std::uint32_t y = 0; y < level.height; ++y) {
        float* to = &level.at[y * level.row_length()];
        if (is_even) {
            const float* upper = above.row(2 * y);
            halve_row(upper, above.row(2 * y + 1), level.row_length(), to);
            continue;
        }
        const Cover rows = cover_of(y, level.height, above.height);
        for (std::uint32_t dy = 0; dy < 3; ++dy) {
            if (rows.weights.at(dy) == 0.0F) {
                continue;
            }
            const float* from = above.row(std::min(rows.first + dy, above.height - 1));
            for (std::uint32_t x = 0; x < level.width; ++x) {
                for (std::uint32_t dx = 0; dx < 3; ++dx) {
                    const float weight = rows.weights.at(dy) * columns[x].weights.at(dx);
                    if (weight == 0.0F) {
                        continue;
                    }
                    const std::uint32_t column = std::min(columns[x].first + dx, above.width - 1);
                    for (std::size_t c = 0; c < kChannels; ++c) {
                        to[kChannels * x + c] += weight * from[kChannels * column + c];
                    }
                }
            }
        }
    }
    return level;
}

MipLevel coded(const Values& values, const Image& like) {
    MipLevel level{values.width, values.height, {}};
    const bool srgb = like.color_space == ColorSpace::Srgb;
    const std::size_t count = values.at.size();
    if (like.format == TexelFormat::Rgba8) {
        static const SrgbCodes codes;
        level.texels.resize(count);
        auto* const to = reinterpret_cast<std::uint8_t*>(level.texels.data());
        for (std::size_t i = 0; !srgb && i < count; ++i) {
            to[i] = rounded_byte(within_1(values.at[i]) * kMostByte);
        }
        for (std::size_t i = 0; srgb && i < count; i += kChannels) {
            for (std::size_t c = 0; c < 3; ++c) {
                to[i + c] = codes.of(within_1(values.at[i + c]));
            }
            to[i + 3] = rounded_byte(within_1(values.at[i + 3]) * kMostByte);
        }
        return level;
    }
    level.texels.resize(2 * count);
    for (std::size_t i = 0; i < count; ++i) {
        const float value = srgb && i % kChannels != 3 ? code_of(values.at[i]) : values.at[i];
        const std::uint16_t code = rounded(std::clamp(value, 0.0F, 1.0F) * kMostWord);
        std::memcpy(level.texels.data() + 2 * i, &code, sizeof code);
    }
    return level;
}

}  // namespace

std::vector<MipLevel> smaller_levels(const Image& image) {
    std::vector<MipLevel> levels;
    if (image.width <= 1 && image.height <= 1) {
        return levels;
    }
    ImageRows rows(image);
    Values values = halved(rows);
    levels.push_back(coded(values, image));
    while (values.width > 1 || values.height > 1) {
        values = halved(std::as_const(values));
        levels.push_back(coded(values, image));
    }
    return levels;
}

Image as_light(const Image& image) {
    Image light = image;
    light.color_space = ColorSpace::Linear;
    const ImageRows rows(image);
    Values values{image.width, image.height, {}};
    values.at.resize(values.row_length() * values.height);
    for (std::uint32_t y = 0; y < values.height; ++y) {
        rows.read(y, &values.at[y * values.row_length()]);
    }
    const MipLevel coded_light = coded(values, light);
    light.texels.assign(coded_light.texels.begin(), coded_light.texels.end());
    return light;
}

}  // namespace gazeloop::scene::mesh
