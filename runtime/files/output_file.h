#pragma once

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "runtime/error.h"
#include "runtime/files/unfinished_files.h"

namespace gazeloop::files {

/// Checks whether write_text() should succeed, so that a long run is not started for nothing.
/// Creates and changes nothing. Errors (BadInput): file and reason are named.
Expected<void> check_output(const std::filesystem::path& file);

/// How a file is written.
struct OutputOptions {
    mode_t mode = 0666;    ///< of a new file, less the umask; below that also of a replaced one
    bool durable = false;  ///< it is on the disk before it takes the place of what was there
};
/// Of what is one person's.
inline constexpr OutputOptions kOwnerOnly{.mode = 0600, .durable = true};

/// A file that is written piece by piece; "-" is stdout. The one rule for all outputs:
///
/// - an existing file is replaced at the end, by a complete new one, or, in a folder without write
///   permission, written in place; links are followed;
/// - what is no file is never replaced and never removed. A character device or a pipe is written
///   in place; a folder, a socket or a block device is refused;
/// - a recording is never replaced: it cannot be had again (recording_file.h).
///
/// Without close(), what was there before stays, unless it is written in place.
class OutputFile {
  public:
    /// Errors (BadInput): file and reason are named, here and below.
    static Expected<OutputFile> open(const std::filesystem::path& file,
                                     const OutputOptions& options = {});
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    OutputFile(OutputFile&& other) noexcept;
    OutputFile& operator=(OutputFile&&) = delete;
    ~OutputFile();

    /// Not after an error.
    Expected<void> write(std::string_view text);
    /// Once, after the last piece; not after an error.
    Expected<void> close();

  private:
    OutputFile(std::filesystem::path file, std::filesystem::path real, std::string beside,
               int descriptor, bool durable);
    /// Closes and removes what is unfinished.
    void abandon();

    std::filesystem::path file_;  ///< as it was named
    std::filesystem::path real_;  ///< what it stands for
    std::string beside_;          ///< becomes the file in the end; empty: written in place
    std::unique_ptr<UnfinishedFile> unfinished_;  ///< that file
    int descriptor_;                              ///< -1: closed
    bool durable_;
};

/// Writes a whole file by that rule. What was there before still is after an error, unless it is
/// written in place. Errors (BadInput): file and reason are named.
Expected<void> write_text(const std::filesystem::path& file, std::string_view text,
                          const OutputOptions& options = {});

/// What a name stands for: links are followed.
[[nodiscard]] std::filesystem::path followed(const std::filesystem::path& file);

}  // namespace gazeloop::files
