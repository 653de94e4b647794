#pragma once

#include <memory>
#include <ostream>
#include <streambuf>
#include <string>

#include "runtime/error.h"

namespace gazeloop::drivers {

/// A file of text that is written piece by piece, as files::OutputFile writes; gzip where its name
/// ends with ".gz" (without a time in it, so that the same text gives the same bytes).
class TextOutput {
  public:
    explicit TextOutput(const std::string& file);
    TextOutput(const TextOutput&) = delete;
    TextOutput& operator=(const TextOutput&) = delete;
    ~TextOutput();

    [[nodiscard]] std::ostream& stream() { return stream_; }

    /// Once, after the last piece. Errors (BadInput): a file that could not be opened or written,
    /// whenever that was, with the reason.
    [[nodiscard]] Expected<void> close();

  private:
    class Pieces;

    std::unique_ptr<Pieces> pieces_;
    std::ostream stream_;
};

}  // namespace gazeloop::drivers
