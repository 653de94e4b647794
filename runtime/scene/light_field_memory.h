#pragma once

#include <cstdint>

namespace gazeloop::scene {

/// What a light field's views may take, and how they are kept.
struct LightFieldMemory {
    std::uint64_t most_bytes = std::uint64_t{1} << 30U;  ///< of the GPU's memory
    bool compressed = false;                             ///< BC1
    bool fetch_ahead = true;  ///< views that do not fit are loaded before frames ask for them
};

}  // namespace gazeloop::scene
