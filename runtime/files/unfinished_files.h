#pragma once

#include <cstddef>
#include <string>

namespace gazeloop::files {

/// Files that this process has begun and nobody may find half done, so that whoever ends it at once
/// can remove them.
class UnfinishedFile {
  public:
    /// Remembers a file until it is finished. Of more than so many at a time, or of a longer name,
    /// nothing is remembered: it then stays behind.
    explicit UnfinishedFile(const std::string& file);
    UnfinishedFile(const UnfinishedFile&) = delete;
    UnfinishedFile& operator=(const UnfinishedFile&) = delete;
    ~UnfinishedFile();

    static constexpr std::size_t kMost = 16;
    static constexpr std::size_t kLongestName = 4096;  ///< bytes, the end included

  private:
    std::size_t slot_ = kMost;
};

/// Removes all of them. For a signal's handler: allocates nothing and waits for nothing.
void remove_unfinished_files() noexcept;

}  // namespace gazeloop::files
