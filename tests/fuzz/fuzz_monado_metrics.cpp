// Any bytes as Monado's metrics file: an error with the file's name, or frames whose times are of
// the kind that their fate says.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <set>
#include <sstream>
#include <string>

#include "runtime/report/runtime_metrics/monado_frames.h"

namespace {

using namespace gazeloop;
using report::MonadoFate;

void require(bool held) {
    if (!held) {
        std::abort();
    }
}

Expected<report::MonadoMetricsReader> open(const std::string& bytes) {
    return report::MonadoMetricsReader::open(std::make_unique<std::istringstream>(bytes), "fuzz");
}

void require_kinds(const report::MonadoShown& shown) {
    switch (shown.fate) {
        case MonadoFate::Presented:
            require(shown.present.kind == time::StampKind::Measured);
            require(shown.shown.kind == time::StampKind::Profile);
            break;
        case MonadoFate::Modelled:
            require(shown.present.kind == time::StampKind::Modelled);
            require(shown.shown.kind == time::StampKind::Modelled);
            break;
        default:
            require(!shown.present.known() && !shown.shown.known());
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string bytes(data, data + size);
    auto reader = open(bytes);
    if (!reader) {
        require(reader.error().kind == ErrorKind::BadInput &&
                reader.error().message.starts_with("fuzz:"));
        return 0;
    }
    std::set<std::int64_t> displays{-1, 0, 1};
    while (const auto record = reader->next()) {
        if (const auto* const frame = std::get_if<report::MonadoSessionFrame>(&*record)) {
            displays.insert(frame->predicted_display_ns);
        }
    }
    const report::MonadoFileCounts& counts = reader->counts();
    require(counts.records >= 1 && counts.unknown < counts.records);
    require(!(counts.cut_at && counts.lost_at) && counts.cut_at.value_or(0) < size);
    report::MonadoFrames frames(value_or_throw(open(bytes)));
    for (const std::int64_t display_ns : displays) {
        frames.read_until(display_ns);
        require_kinds(frames.find(display_ns, 0));
    }
    return 0;
}
