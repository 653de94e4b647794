// Any bytes as WiVRn's timing file: an error with file and line, or stages of frames that are all
// accounted for.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "runtime/report/runtime_metrics/wivrn_stages.h"

namespace {

using namespace gazeloop;

void require(bool held) {
    if (!held) {
        std::abort();
    }
}

void require_named(const std::string& message) { require(message.starts_with("fuzz:")); }

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    auto reader = report::WivrnCsvReader::open(
        std::make_unique<std::istringstream>(std::string(data, data + size)), "fuzz");
    if (!reader) {
        require(reader.error().kind == ErrorKind::BadInput);
        require_named(reader.error().message);
        return 0;
    }
    report::WivrnStages stages(std::move(*reader));
    constexpr std::int64_t kPeriodNs = 10'000'000;
    frame::FrameRecord frame;
    frame.period_ns = kPeriodNs;
    try {
        for (std::int64_t i = 0; i < 100; ++i) {
            frame.index = static_cast<std::uint64_t>(i);
            frame.stamps.end_frame = {i * kPeriodNs, time::StampKind::Measured};
            frame.stamps.display = {(i + 2) * kPeriodNs, time::StampKind::Predicted};
            stages.on_frame(frame);
        }
    } catch (const SetupError& error) {
        require(error.kind() == ErrorKind::BadInput);
        require_named(error.what());
        return 0;
    }
    const report::WivrnJoinCounts& counts = stages.counts();
    require(counts.frames == 100);
    require(counts.joined + counts.not_announced + counts.missing + counts.taken +
                counts.too_early ==
            counts.frames);
    require(!stages.text().empty() && !stages.json().empty());
    return 0;
}
