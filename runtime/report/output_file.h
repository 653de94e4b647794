#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "runtime/error.h"

namespace gazeloop::report {

/// Checks whether write_text() should succeed, so that a long run is not started for nothing.
/// Creates and changes nothing. Errors (BadInput): file and reason are named.
Expected<void> check_output(const std::filesystem::path& file);

/// A file with the option or the word that names it. Empty: none; "-": stdin or stdout.
struct NamedFile {
    std::string_view name;
    std::filesystem::path file;
};

/// Checks that each output has a file of its own, and none of what is read. Links are followed.
/// Errors (Usage): both names and the file.
Expected<void> check_apart(std::span<const NamedFile> outputs, std::span<const NamedFile> inputs);

/// A file that is written piece by piece; "-" is stdout. An existing file is replaced at the end,
/// by a complete new one. Where that is not possible (a device, a folder without write permission),
/// it is written in place. Without close(), what was there before stays, unless it is written in
/// place.
class OutputFile {
  public:
    /// Errors (BadInput): file and reason are named, here and below.
    static Expected<OutputFile> open(const std::filesystem::path& file);
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
               int descriptor);
    /// Closes and removes what is unfinished.
    void abandon();

    std::filesystem::path file_;  ///< as it was named
    std::filesystem::path real_;  ///< what it stands for
    std::string beside_;          ///< becomes the file in the end; empty: written in place
    int descriptor_;              ///< -1: closed
};

/// Writes a whole file; "-" is stdout. An existing file is replaced at the end, by a complete new
/// one. Where that is not possible (a device, a folder without write permission), it is written in
/// place. Errors (BadInput): file and reason are named; what was there before then still is.
Expected<void> write_text(const std::filesystem::path& file, std::string_view text);

}  // namespace gazeloop::report
