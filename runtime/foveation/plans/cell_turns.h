#pragma once

#include <array>
#include <cstdint>

namespace gazeloop::foveation {

/// How texels take turns: a grid is cut into blocks of `every` texels, and each frame shades one
/// place of all blocks. Where a block is wider than high, blocks of odd rows are shifted by half a
/// width, so that what one frame shades lies evenly.
struct CellTurns {
    static constexpr std::array<std::uint32_t, 5> kEvery{1, 2, 4, 8, 16};
    static constexpr std::size_t kMost = 16;  ///< of kEvery

    std::uint32_t every = 1;  ///< one of kEvery

    struct Place {
        std::uint32_t x = 0;
        std::uint32_t y = 0;
        friend bool operator==(const Place&, const Place&) = default;
    };

    [[nodiscard]] constexpr std::uint32_t block_width() const {
        return every >= 8 ? 4 : every >= 2 ? 2 : 1;
    }
    [[nodiscard]] constexpr std::uint32_t block_height() const { return every / block_width(); }

    /// Blocks along a side of so many texels.
    [[nodiscard]] constexpr std::uint32_t columns(std::uint32_t width) const {
        return (width + block_width() - 1) / block_width();
    }
    [[nodiscard]] constexpr std::uint32_t rows(std::uint32_t height) const {
        return (height + block_height() - 1) / block_height();
    }

    /// The place whose turn it is in a frame: each once in `every` frames, in Bayer's order, by
    /// which the places of any few frames in a row lie far apart.
    [[nodiscard]] constexpr Place place(std::uint64_t frame) const {
        using Places = std::array<Place, 16>;
        constexpr Places kOfTwo{{{0, 0}, {1, 0}}};
        constexpr Places kOfFour{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}};
        // Before the shift of odd rows.
        constexpr Places kOfEight{{{0, 0}, {2, 0}, {1, 1}, {3, 1}, {1, 0}, {3, 0}, {0, 1}, {2, 1}}};
        constexpr Places kOfSixteen{{{0, 0},
                                     {2, 2},
                                     {2, 0},
                                     {0, 2},
                                     {1, 1},
                                     {3, 3},
                                     {3, 1},
                                     {1, 3},
                                     {1, 0},
                                     {3, 2},
                                     {3, 0},
                                     {1, 2},
                                     {0, 1},
                                     {2, 3},
                                     {2, 1},
                                     {0, 3}}};
        const auto turn = static_cast<std::size_t>(frame % every);
        switch (every) {
            case 2:
                return kOfTwo.at(turn);
            case 4:
                return kOfFour.at(turn);
            case 8:
                return kOfEight.at(turn);
            case 16:
                return kOfSixteen.at(turn);
            default:
                return {};
        }
    }
};

}  // namespace gazeloop::foveation
