#pragma once

#include <fstream>
#include <memory>
#include <ostream>
#include <streambuf>
#include <string>

#include "runtime/error.h"

namespace gazeloop::drivers {

/// A file of text that is written piece by piece; gzip where its name ends with ".gz" (without a
/// time in it, so that the same text gives the same bytes). An existing file is replaced by
/// close(), by a complete new one; until then, and after an error, it stays as it was. What is no
/// file (a device) is written in place.
class TextOutput {
  public:
    explicit TextOutput(std::string file);
    TextOutput(const TextOutput&) = delete;
    TextOutput& operator=(const TextOutput&) = delete;
    ~TextOutput();

    [[nodiscard]] std::ostream& stream() { return *stream_; }

    /// Once, after the last piece. Errors (BadInput): a file that could not be opened or written,
    /// whenever that was, with the reason.
    [[nodiscard]] Expected<void> close();

  private:
    class Gzip;

    std::string file_;     ///< as it was named
    std::string real_;     ///< what it stands for: links are followed
    std::string written_;  ///< becomes that in the end; empty: done, or nothing to remove
    int opened_errno_ = 0;
    std::ofstream plain_;
    std::unique_ptr<Gzip> gzip_;  ///< null: plain
    std::unique_ptr<std::ostream> stream_;
};

}  // namespace gazeloop::drivers
