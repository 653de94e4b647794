#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runtime/report/output_file.h"
#include "runtime/report/perfetto/perfetto_observer.h"
#include "runtime/session/session_header.h"

namespace gazeloop::report::perfetto {

/// A session's Perfetto trace, on its way into a file while the session is played.
class PerfettoFile {
  public:
    /// "-" is stdout. @throws SetupError (BadInput) if it cannot be written; (Usage) if stdout is a
    /// terminal
    PerfettoFile(const std::filesystem::path& file, const session::SessionHeader& header,
                 SampleDetail samples);

    /// To be told the session. It throws SetupError (BadInput) if the file can no longer be written
    /// (a full disk, say).
    [[nodiscard]] frame::FrameObserver& observer() { return observer_; }

    /// Once, after the session. What the trace lacks, in words, and for each how many.
    /// @throws SetupError as the observer does
    [[nodiscard]] std::vector<std::string> finish();

  private:
    OutputFile file_;
    PerfettoObserver observer_;
};

}  // namespace gazeloop::report::perfetto
