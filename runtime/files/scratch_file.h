#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "runtime/error.h"

namespace gazeloop::files {

/// Where large files go that only this process needs: $TMPDIR, else /var/tmp, which unlike /tmp is
/// never kept in memory.
[[nodiscard]] std::filesystem::path scratch_folder();

/// A file without a name, gone with the process however that ends: what is too much for memory.
class ScratchFile {
  public:
    /// Takes the space on the disk at once, so that no later write can lack it. Errors (BadInput):
    /// the folder cannot be written or has not that much left; folder, size and TMPDIR are named.
    static Expected<ScratchFile> create(std::uint64_t bytes,
                                        const std::filesystem::path& folder = scratch_folder());
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;
    ScratchFile(ScratchFile&& other) noexcept;
    ScratchFile& operator=(ScratchFile&&) = delete;
    ~ScratchFile();

    /// Precondition, here and below: it lies within the file's size. Errors (BadInput): the disk's.
    Expected<void> write(std::uint64_t offset, std::span<const std::byte> bytes);
    Expected<void> read(std::uint64_t offset, std::span<std::byte> bytes) const;

  private:
    ScratchFile(std::filesystem::path folder, int descriptor);

    std::filesystem::path folder_;
    int descriptor_;
};

}  // namespace gazeloop::files
