#include "runtime/report/perfetto/perfetto_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <utility>

#include "runtime/report/session_summary.h"

namespace gazeloop::report::perfetto {
namespace {

OutputFile open(const std::filesystem::path& file) {
    if (file == "-" && ::isatty(STDOUT_FILENO) == 1) {
        throw SetupError(ErrorKind::Usage,
                         "a Perfetto trace is no text: name a file, or send stdout to one");
    }
    return value_or_throw(OutputFile::open(file));
}

std::string about(const session::SessionMeta& meta) {
    return fmt::format("{}, started {}, target {}, display {}. Times are {}.", meta.program,
                       meta.started_utc, meta.target, meta.display.name,
                       meta.clock == latency::LoopClock::Virtual
                           ? "virtual: they count from 0 and are no clock's"
                           : "CLOCK_MONOTONIC");
}

PerfettoConfig config_of(const session::SessionHeader& header, SampleDetail samples) {
    PerfettoConfig config{.session = summary_config(header.meta.display, header.meta.clock),
                          .about = about(header.meta),
                          .samples = samples};
    config.session.passes = header.passes;
    return config;
}

}  // namespace

PerfettoFile::PerfettoFile(const std::filesystem::path& file, const session::SessionHeader& header,
                           SampleDetail samples)
    : file_(open(file)), observer_(config_of(header, samples), [this](std::string_view bytes) {
          value_or_throw(file_.write(bytes));
      }) {}

std::vector<std::string> PerfettoFile::finish() {
    observer_.finish();
    value_or_throw(file_.close());
    std::vector<std::string> lacks = observer_.unshown().texts();
    if (const std::uint64_t samples = observer_.samples_left_out(); samples > 0) {
        lacks.push_back(fmt::format(
            "samples that no frame rested on: {} (--perfetto-samples all draws them)", samples));
    }
    return lacks;
}

}  // namespace gazeloop::report::perfetto
