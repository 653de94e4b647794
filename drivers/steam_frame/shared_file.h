#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "drivers/steam_frame/gaze_record.h"
#include "runtime/error.h"

namespace gazeloop::drivers::steam_frame {

/// A file in shared memory that another program writes, opened for reading. It is read by pread()
/// and never mapped: a file that its writer cuts short then gives a short read, and no SIGBUS.
class SharedFile {
  public:
    /// None where there is no such file. Errors (NoDevice): it may not be opened, or is no regular
    /// file.
    [[nodiscard]] static Expected<std::optional<SharedFile>> open(const std::string& path);
    SharedFile(SharedFile&& other) noexcept;
    SharedFile(const SharedFile&) = delete;
    SharedFile& operator=(SharedFile&&) = delete;
    SharedFile& operator=(const SharedFile&) = delete;
    ~SharedFile();

    /// The begin of the file, as it is now: its writer may be half way. Errors (NoDevice): it is
    /// shorter than that, or cannot be read.
    [[nodiscard]] Expected<void> read(Image& image) const;

    /// Why the path is not this file any more: it was removed, or is another one. None where it is.
    [[nodiscard]] std::optional<std::string> why_gone() const;

  private:
    SharedFile(int fd, std::string path) : fd_(fd), path_(std::move(path)) {}

    int fd_;
    std::string path_;
};

/// How far apart the two reads of a sample are. A service stores its 129 bytes in well under that.
inline constexpr std::int64_t kSettle_ns = 20'000;

/// Reads a sample without the writer's lock into `image`: false where the counter is still
/// `known_counter`, or where several attempts were all torn. A sample is taken where two reads,
/// `settle_ns` (0: at once) apart, have the same counter and the same record to the last byte. That
/// holds whether the writer stores the counter first or last, unless it stands still for so long
/// within its stores. `torn` counts the attempts that it was half way through. Errors: as
/// SharedFile::read.
[[nodiscard]] Expected<bool> read_new(const SharedFile& file, const Layout& layout,
                                      std::optional<std::uint32_t> known_counter,
                                      std::int64_t settle_ns, Image& image, std::uint64_t& torn);

}  // namespace gazeloop::drivers::steam_frame
