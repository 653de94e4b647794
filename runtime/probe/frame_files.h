#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "runtime/error.h"

namespace gazeloop::probe {

/// The frames of a video as numbered PNG files of one folder: PREFIX, a number, ".png". Only the
/// pattern is kept, so that the memory does not depend on the number of frames.
class FrameFiles {
  public:
    /// Other files of the folder are left alone, but every .png must be of one numbering. Errors
    /// (BadInput): no such folder, no numbered .png, a .png that is of no or of another numbering,
    /// a number that is missing or there twice. Names the file.
    [[nodiscard]] static Expected<FrameFiles> find(const std::filesystem::path& folder);

    [[nodiscard]] std::uint64_t count() const { return last_ - first_ + 1; }
    /// Precondition: index < count().
    [[nodiscard]] std::filesystem::path file(std::uint64_t index) const {
        return folder_ / name_of(first_ + index);
    }

  private:
    [[nodiscard]] std::string name_of(std::uint64_t number) const;

    std::filesystem::path folder_;
    std::string prefix_;
    std::size_t digits_ = 1;  ///< at least so many, with leading zeros
    std::uint64_t first_ = 0;
    std::uint64_t last_ = 0;
};

}  // namespace gazeloop::probe
