#include "drivers/trace/bids/read_bids.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

#include "drivers/trace/bids/bids_files.h"
#include "drivers/trace/bids/eye_recording.h"
#include "drivers/trace/bids/joined_eyes.h"
#include "drivers/trace/clock/device_times.h"
#include "drivers/trace/clock/rows_read.h"
#include "drivers/trace/trace_builder.h"

namespace gazeloop::drivers {
namespace {

namespace fs = std::filesystem;

std::unexpected<Error> bad_input(const fs::path& file, std::string_view what) {
    return std::unexpected(Error{ErrorKind::BadInput, fmt::format("{}: {}", file.string(), what)});
}

/// The file itself, and those of the other eyes beside it.
std::vector<fs::path> recordings_of(const fs::path& file) {
    std::vector<fs::path> files{file};
    const std::optional<BidsName> name = bids_name(file);
    const auto label = name->entities.find("recording");
    if (label == name->entities.end() || !label->second.starts_with("eye")) {
        return files;
    }
    for (const std::string_view other : {"eye1", "eye2", "eye3"}) {
        std::error_code ignored;
        const fs::path beside = packed_or_not(with_recording(file, other, "physio"));
        if (other != label->second && fs::exists(beside, ignored)) {
            files.push_back(beside);
        }
    }
    return files;
}

/// All rows of a recording.
Expected<EyeRows> rows_of(EyeRecording& recording, const fs::path& file, BadCells& bad) {
    EyeRows eye{.name = file.filename().string(),
                .of = {recording.is_of(gaze::Eye::Left), recording.is_of(gaze::Eye::Right)},
                .stated_rate_hz = recording.stated_rate_hz(),
                .rows = {}};
    while (true) {
        const Expected<bool> more = recording.next(bad);
        if (!more) {
            return std::unexpected(more.error());
        }
        if (!*more) {
            return eye;
        }
        eye.rows.push_back(recording.row());
    }
}

}  // namespace

Expected<BuiltTrace> read_bids(const fs::path& file, const ReadOptions& options) {
    if (!is_bids_physio(file)) {
        return bad_input(file,
                         "BIDS names eye tracking sub-LABEL_..._recording-eye1_physio.tsv.gz: give "
                         "it such a name, and its sidecar");
    }
    std::vector<EyeRecording> recordings;
    std::vector<EyeRows> eyes;
    gaze::PerEye<bool> covered{};
    std::vector<std::string> left_out;
    BadCells bad;
    for (const fs::path& each : recordings_of(file)) {
        Expected<EyeRecording> recording = EyeRecording::open(each);
        if (!recording) {
            return std::unexpected(recording.error());
        }
        const bool anew = (recording->is_of(gaze::Eye::Left) && covered[0]) ||
                          (recording->is_of(gaze::Eye::Right) && covered[1]);
        if (anew) {
            left_out.push_back(each.filename().string());
            continue;
        }
        covered = {covered[0] || recording->is_of(gaze::Eye::Left),
                   covered[1] || recording->is_of(gaze::Eye::Right)};
        Expected<EyeRows> eye = rows_of(*recording, each, bad);
        if (!eye) {
            return std::unexpected(eye.error());
        }
        recordings.push_back(std::move(*recording));
        eyes.push_back(std::move(*eye));
    }
    TraceBuilder builder(
        {.file = file.string(), .format = kBids, .device = recordings.front().device()});
    builder.clock_is("timestamp", recordings.front().time_unit_ns());
    JoinedEyes joined;
    if (eyes.size() > 1) {
        Expected<JoinedEyes> both = join_eyes(eyes[0], eyes[1]);
        if (!both) {
            return std::unexpected(both.error());
        }
        joined = std::move(*both);
    } else {
        joined.findings = doubt_stated_rate(eyes[0], device_times(RowsRead(eyes[0].rows), 1.0));
        joined.rows = std::move(eyes[0].rows);
    }
    for (const TraceRow& row : joined.rows) {
        builder.add(row);
    }
    gaze::TraceReport& report = builder.report();
    for (const EyeRecording& recording : recordings) {
        recording.report_to(report);
        if (!builder.knows_unread_time() && !recording.unread_time().empty()) {
            builder.unread_time(recording.unread_time());
        }
    }
    bad.report_to(report);
    for (const std::string& name : left_out) {
        report.add(
            {.kind = gaze::TraceFindingKind::NotRead,
             .text = fmt::format("{} beside it has an eye that another has too: left out", name)});
    }
    report.rows += joined.dropped;
    for (gaze::TraceFinding& finding : joined.findings) {
        report.add(std::move(finding));
    }
    return builder.finish(options);
}

}  // namespace gazeloop::drivers
