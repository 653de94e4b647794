#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gazeloop::scene {

/// Of a picture as BC1: half a byte per texel, sides rounded up to blocks of 4.
[[nodiscard]] constexpr std::uint64_t bc1_bytes(std::uint32_t width_px, std::uint32_t height_px) {
    return std::uint64_t{8} * ((width_px + 3) / 4) * ((height_px + 3) / 4);
}

/// Compresses a picture (RGBA, 8 bits, top row first) to BC1, an eighth of its bytes: blocks of 4 x
/// 4 texels with two colours of 5, 6 and 5 bits and two between them, chosen along the block's
/// principal axis and then by least squares. What is opaque stays so; alpha is ignored. The result
/// depends on the picture alone. Lossy: where a block's colours lie on one line, by no more than
/// half a step of its colours (quantisation included, 8 codes of 255 in a block of full contrast
/// 21); where they do not, by what is off that line.
[[nodiscard]] std::vector<std::byte> compress_bc1(std::span<const std::byte> rgba,
                                                  std::uint32_t width_px, std::uint32_t height_px);

}  // namespace gazeloop::scene
