#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "runtime/error.h"
#include "runtime/light_field/lens.h"

namespace gazeloop::scene {

/// What a light field's views may be kept in.
struct StorageLimits {
    std::uint64_t most_bytes = 0;   ///< of the GPU's memory, for all of it
    std::uint32_t most_layers = 0;  ///< of one image
    /// What an image of so many views takes; it grows with their number.
    std::function<std::uint64_t(std::uint32_t layers)> image_bytes;
    std::uint64_t most_image_bytes = 0;  ///< of one image
    std::uint32_t most_ahead = 0;        ///< views that may be fetched ahead at a time
};

/// The views of a light field.
struct StoredViews {
    std::string name;  ///< of the light field, for messages
    std::uint32_t width_px = 0;
    std::uint32_t height_px = 0;
    std::uint64_t bytes = 0;  ///< of one, as it is copied to the GPU
    bool compressed = false;
};

/// How a light field's views are kept on the GPU.
struct LightFieldStorage {
    std::uint32_t layers = 0;  ///< of the image
    std::uint32_t staged = 0;  ///< views that the buffer holds through which they are loaded
    std::uint32_t ahead = 0;   ///< likewise, of those that are fetched ahead
    bool streamed = false;     ///< fewer layers than views: frames wait for theirs
};

/// All views, where they fit: the buffer they are loaded through is given back then. Else as many
/// as fit, which must be no fewer than two eyes' pictures can be made of. As many as are beyond
/// those by twice their number may be fetched ahead: each takes a layer, and room in the buffer.
/// Errors (BadInput): they do not fit, with what that takes and what would.
[[nodiscard]] Expected<LightFieldStorage> choose_storage(const light_field::LightField& field,
                                                         const StoredViews& views,
                                                         const StorageLimits& limits);

}  // namespace gazeloop::scene
