#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <string>

#include "runtime/scene/gltf/refusal.h"

namespace gazeloop::scene::gltf {

/// What a file may ask for at most. Beyond it the file is refused before memory is taken.
struct LoadLimits {
    /// Of a picture. What Vulkan devices have, lavapipe among them.
    std::uint32_t most_texels_per_side = 16384;
    /// Of everything together: files in memory, vertices, indices, decoded pictures.
    std::uint64_t most_bytes = std::uint64_t{8} << 30U;
};

/// The bytes that a file has asked for so far. Several threads may take.
class Budget {
  public:
    explicit Budget(const LoadLimits& limits) : limits_(limits) {}

    [[nodiscard]] const LoadLimits& limits() const { return limits_; }
    [[nodiscard]] std::uint64_t taken_bytes() const { return taken_; }

    /// Throws Refusal where it would be more than allowed. `what` is asked for, at `place`.
    void take(std::uint64_t bytes, const std::string& place, std::string_view what) {
        const std::uint64_t before = taken_.fetch_add(std::min(bytes, limits_.most_bytes + 1));
        if (bytes > limits_.most_bytes || before > limits_.most_bytes - bytes) {
            refuse(place, fmt::format("{} need {} bytes, with what is loaded already more than the "
                                      "{} that a scene may take; make it smaller",
                                      what, bytes, limits_.most_bytes));
        }
    }

  private:
    LoadLimits limits_;
    std::atomic<std::uint64_t> taken_ = 0;
};

}  // namespace gazeloop::scene::gltf
