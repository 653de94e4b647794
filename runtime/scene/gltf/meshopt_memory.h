#pragma once

#include <cstddef>

#include "runtime/memory/large_pages.h"

namespace gazeloop::scene::gltf {

/// While one lives, meshoptimizer's calls in its thread work in memory that is kept from call to
/// call. By itself it takes a hundred bytes per triangle from the system at every call and gives
/// them back, and the faults of fresh pages take longer than its work. One at a time in a thread,
/// and released in that thread.
class MeshoptMemory {
  public:
    MeshoptMemory();
    MeshoptMemory(const MeshoptMemory&) = delete;
    MeshoptMemory& operator=(const MeshoptMemory&) = delete;
    ~MeshoptMemory();

    /// As a stack: what was taken last is given back first. Null: it does not fit.
    [[nodiscard]] void* take(std::size_t bytes);
    /// Whether it was taken from here. Of what did not fit, it must be told too.
    bool give_back(const void* taken) noexcept;

  private:
    memory::LargePagesVector<std::byte> block_;
    std::size_t taken_bytes_ = 0;  ///< of the block
    std::size_t open_ = 0;         ///< takes that are not given back
    std::size_t asked_bytes_ = 0;  ///< by a call, whether it fit or not
    std::size_t most_bytes_ = 0;   ///< that a call asked for
};

}  // namespace gazeloop::scene::gltf
