#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "runtime/error.h"

namespace gazeloop::memory {

/// Where large files go that only this process needs: what TMPDIR names, else /var/tmp, which is on
/// a disk where /tmp may not be.
[[nodiscard]] std::string scratch_folder();

/// A file without a name, so that nothing of it is left however the program ends. Its owner alone
/// may read it.
class ScratchFile {
  public:
    /// Errors (BadInput), here and below: the folder is named, with the reason and what to do.
    static Expected<ScratchFile> make(const std::string& folder = scratch_folder());
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;
    ScratchFile(ScratchFile&& other) noexcept;
    ScratchFile& operator=(ScratchFile&& other) noexcept;
    ~ScratchFile();

    /// Takes the disk's room for so many bytes, zeros, now: no later write of them can lack it.
    [[nodiscard]] Expected<void> reserve(std::size_t bytes);
    [[nodiscard]] Expected<void> write(std::size_t at, std::span<const std::byte> bytes);
    /// Precondition: so much was written or reserved there.
    [[nodiscard]] Expected<void> read(std::size_t at, std::span<std::byte> bytes) const;

    /// So many bytes of zeros, mapped, for which the disk has room; munmap() frees them, and the
    /// file may be closed before.
    [[nodiscard]] Expected<void*> map(std::size_t bytes);

    /// The folder, where what is written there takes memory after all; else empty.
    [[nodiscard]] std::string in_memory() const;

  private:
    ScratchFile(std::string folder, int descriptor);

    std::string folder_;
    int descriptor_;  ///< -1: moved from
};

}  // namespace gazeloop::memory
