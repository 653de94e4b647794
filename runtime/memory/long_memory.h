#pragma once

#include <cstddef>
#include <string>
#include <thread>

namespace gazeloop::memory {

class ScratchFile;

/// A block of so many bytes or more is long: under a MemoryLimit it is mapped by itself, and may
/// lie in a scratch file. Shorter ones, and all without a limit, are as new makes them.
inline constexpr std::size_t kLongBlock = std::size_t{256} << 10U;

/// A block for a vector that grows with a recording (long_vector.h). Throws SetupError (BadInput)
/// where a scratch file is needed and cannot be made: folder, size and remedy are named.
/// std::bad_alloc where there is no memory.
[[nodiscard]] void* allocate(std::size_t bytes);
/// `bytes` as it was allocated with.
void release(void* block, std::size_t bytes) noexcept;

/// While it lives, long blocks take so much of the process's memory together; those that do not
/// fit lie in scratch files (scratch_file.h), and so does all of a spool (spool.h). Their pages
/// leave the process again as they are used, for the kernel's page cache, which is given up where
/// memory is short. Blocks that are there when it begins or ends stay where they are. One at a
/// time.
class MemoryLimit {
  public:
    explicit MemoryLimit(std::size_t bytes);
    MemoryLimit(const MemoryLimit&) = delete;
    MemoryLimit& operator=(const MemoryLimit&) = delete;
    ~MemoryLimit();

    /// Why scratch files that were used in its time do not save memory, with the remedy; empty
    /// where they do, or none was needed.
    [[nodiscard]] std::string doubt() const;

    /// Whether there is one.
    [[nodiscard]] static bool in_force();
    /// Takes a scratch file that was made into account (doubt()).
    static void note(const ScratchFile& file);

  private:
    std::jthread keeper_;  ///< lets go of pages; the last member, so that it ends first
};

/// What long blocks take now, bytes.
struct LongBlocks {
    std::size_t in_memory = 0;
    std::size_t in_files = 0;
};
[[nodiscard]] LongBlocks long_blocks();

}  // namespace gazeloop::memory
