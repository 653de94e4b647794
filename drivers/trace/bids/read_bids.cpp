#include "drivers/trace/bids/read_bids.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

#include "drivers/trace/bids/bids_files.h"
#include "drivers/trace/bids/eye_recording.h"
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
        const fs::path beside = with_recording(file, other, "physio");
        if (other != label->second && fs::exists(beside, ignored)) {
            files.push_back(beside);
        }
    }
    return files;
}

/// Rows of one or two recordings, put together where their times are the same.
class JoinedRows {
  public:
    explicit JoinedRows(std::vector<EyeRecording>& recordings) : recordings_(recordings) {
        has_.resize(recordings.size(), false);
    }

    [[nodiscard]] Expected<bool> next(TraceRow& row, BadCells& bad) {
        for (std::size_t i = 0; i < recordings_.size(); ++i) {
            if (!has_[i]) {
                const Expected<bool> more = recordings_[i].next(bad);
                if (!more) {
                    return more;
                }
                has_[i] = *more;
            }
        }
        const std::optional<std::size_t> first = earliest();
        if (!first) {
            return false;
        }
        row = recordings_[*first].row();
        has_[*first] = false;
        for (std::size_t i = 0; i < recordings_.size(); ++i) {
            if (!has_[i] || !row.device_ticks ||
                recordings_[i].row().device_ticks != row.device_ticks) {
                continue;
            }
            for (const gaze::Eye eye : gaze::kEyes) {
                if (recordings_[i].is_of(eye)) {
                    row.eyes[gaze::index(eye)] = recordings_[i].row().eyes[gaze::index(eye)];
                }
            }
            row.head = row.head ? row.head : recordings_[i].row().head;
            has_[i] = false;
            ++joined_;
        }
        return true;
    }

    [[nodiscard]] std::uint64_t joined() const { return joined_; }

  private:
    /// A row without a time goes first, since nothing says where it belongs.
    [[nodiscard]] std::optional<std::size_t> earliest() const {
        std::optional<std::size_t> first;
        for (std::size_t i = 0; i < recordings_.size(); ++i) {
            if (has_[i] && (!first || recordings_[i].row().device_ticks <
                                          recordings_[*first].row().device_ticks)) {
                first = i;
            }
        }
        return first;
    }

    std::vector<EyeRecording>& recordings_;
    std::vector<bool> has_;
    std::uint64_t joined_ = 0;
};

}  // namespace

Expected<gaze::GazeTrace> read_bids(const fs::path& file, const ReadOptions& options) {
    if (!is_bids_physio(file)) {
        return bad_input(file,
                         "BIDS names eye tracking sub-LABEL_..._recording-eye1_physio.tsv.gz: give "
                         "it such a name, and its sidecar");
    }
    std::vector<EyeRecording> recordings;
    gaze::PerEye<bool> covered{};
    std::vector<std::string> left_out;
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
        recordings.push_back(std::move(*recording));
    }
    TraceBuilder builder(
        {.file = file.string(), .format = kBids, .device = recordings.front().device()});
    BadCells bad;
    JoinedRows rows(recordings);
    TraceRow row;
    while (true) {
        const Expected<bool> more = rows.next(row, bad);
        if (!more) {
            return std::unexpected(more.error());
        }
        if (!*more) {
            break;
        }
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
    const auto note = [&](std::string text) {
        report.add({.kind = gaze::TraceFindingKind::Text, .text = std::move(text)});
    };
    for (const std::string& name : left_out) {
        note(fmt::format("{} beside it has an eye that another has too: left out", name));
    }
    if (recordings.size() > 1) {
        note(fmt::format("two recordings, of which {} rows have the same times", rows.joined()));
    }
    return builder.finish(options);
}

}  // namespace gazeloop::drivers
