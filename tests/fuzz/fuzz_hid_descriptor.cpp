// Any bytes as a report descriptor: a refusal, or fields that lie inside their reports.

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "drivers/hid/eye_tracker_layout.h"

namespace {

void require(bool held) {
    if (!held) {
        std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gazeloop;
    using namespace gazeloop::drivers::hid;
    const Expected<ReportDescriptor> parsed = parse_report_descriptor({data, size});
    if (!parsed) {
        require(parsed.error().kind == ErrorKind::BadInput && !parsed.error().message.empty());
        return 0;
    }
    for (const ReportField& field : parsed->fields) {
        const ReportSize* const report = find_report(parsed->reports, field.kind, field.report_id);
        require(report != nullptr && field.bits > 0 && field.count > 0);
        require(std::uint64_t{field.bit_offset} + std::uint64_t{field.bits} * field.count <=
                report->bits);
        require(report->payload_bytes() <= kLongestReport);
        require(field.usages.empty() || field.usage_of(0xFFFFFFFFU) <= field.usages.back().last ||
                field.usages.size() > 1);
    }
    const auto inside = [&](const ReportValue& value) {
        const ReportSize* const report = find_report(parsed->reports, value.kind, value.report_id);
        require(report != nullptr && value.bits >= 1 && value.bits <= 64 &&
                value.bit_offset + value.bits <= report->bits);
    };
    if (const auto layout = find_eye_tracker(*parsed)) {
        for (const TrackingLayout& tracking : layout->tracking) {
            for (const auto& axis : tracking.gaze_point) {
                if (axis) {
                    inside(*axis);
                }
            }
            require(!tracking.timestamp ||
                    (tracking.timestamp->bits >= 1 && tracking.timestamp->bits <= 64 &&
                     tracking.timestamp->tick_ns > 0.0));
        }
        if (layout->mode_request) {
            inside(*layout->mode_request);
        }
    }
    return 0;
}
