#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "runtime/probe/frame_files.h"

namespace gazeloop::compare {

/// The pictures of one side: one file, or a folder's numbered frames.
class ComparedFiles {
  public:
    /// @throws SetupError as FrameFiles::find() for a folder
    [[nodiscard]] static ComparedFiles find(const std::filesystem::path& path);

    [[nodiscard]] bool folder() const { return frames_.has_value(); }
    [[nodiscard]] std::uint64_t count() const { return frames_ ? frames_->count() : 1; }
    /// Precondition: frame < count().
    [[nodiscard]] std::filesystem::path file(std::uint64_t frame) const {
        return frames_ ? frames_->file(frame) : path_;
    }

  private:
    std::filesystem::path path_;
    std::optional<probe::FrameFiles> frames_;
};

}  // namespace gazeloop::compare
