#include "runtime/vulkan/processor.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#if defined(__x86_64__)
#include <cpuid.h>
#include <immintrin.h>
#endif

namespace gazeloop::vulkan {

std::string processor_name() {
#if defined(__x86_64__)
    constexpr unsigned kFirst = 0x80000002;  // of three leaves of 16 bytes each
    constexpr unsigned kLeaves = 3;
    std::array<unsigned, 4 * kLeaves> words{};
    for (unsigned leaf = 0; leaf < kLeaves; ++leaf) {
        unsigned* const at = words.data() + std::size_t{4} * leaf;
        if (__get_cpuid(kFirst + leaf, &at[0], &at[1], &at[2], &at[3]) == 0) {
            return {};
        }
    }
    std::array<char, sizeof words + 1> text{};
    std::memcpy(text.data(), words.data(), sizeof words);
    const std::string name = text.data();
    const std::size_t first = std::min(name.find_first_not_of(' '), name.size());
    return name.substr(first, name.find_last_not_of(' ') + 1 - first);
#else
    return {};
#endif
}

std::uint64_t inverse_square_root_hash() {
#if defined(__x86_64__)
    // Tables are indexed by no more than 13 leading bits of the mantissa, and the exponent's last.
    constexpr std::uint32_t kOne = std::bit_cast<std::uint32_t>(1.0F);
    constexpr std::uint32_t kSteps = 1U << 13U;
    constexpr std::uint32_t kStep = 1U << 11U;
    constexpr std::uint64_t kSeed = 0xcbf29ce484222325;  // FNV-1a
    constexpr std::uint64_t kPrime = 0x100000001b3;
    std::uint64_t hash = kSeed;
    for (std::uint32_t i = 0; i < kSteps; ++i) {
        const auto number = std::bit_cast<float>(kOne + i * kStep);
        const float root = _mm_cvtss_f32(_mm_rsqrt_ss(_mm_set_ss(number)));
        hash = (hash ^ std::bit_cast<std::uint32_t>(root)) * kPrime;
    }
    return hash;
#else
    return 0;
#endif
}

}  // namespace gazeloop::vulkan
