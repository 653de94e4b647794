#include "runtime/latency/gaze_use.h"

#include <algorithm>

#include "runtime/latency/gaze_age.h"

namespace gazeloop::latency {
namespace {

std::optional<double> percent(std::uint64_t part, std::uint64_t whole) {
    return whole == 0
               ? std::nullopt
               : std::optional(100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

}  // namespace

std::optional<double> GazeUseCounts::reused_percent() const { return percent(reused, comparable); }
std::optional<double> GazeUseCounts::lost_percent() const { return percent(lost, rendered); }

void GazeUse::Running::add(const frame::FrameRecord& frame) {
    if (frames == 0) {
        first = frame.index;
        since = frame.stamps.wake_up;
    }
    ++frames;
}

void GazeUse::Running::keep_longest(FrameStretch& longest, const time::Stamp& until) const {
    if (frames > longest.frames) {
        longest = {.frames = frames, .first = first, .lasted = time::between(since, until)};
    }
}

void GazeUse::add(const frame::FrameRecord& frame) {
    if (!frame.should_render) {
        return;
    }
    ++counts_.rendered;
    if (before_ && *before_ + 1 != frame.index) {
        sequence_before_.reset();
        reuse_ = {};
        loss_ = {};
    }
    before_ = frame.index;
    const time::Stamp& now = frame.stamps.wake_up;
    const gaze::FoveaState state = std::max(frame.fovea.eyes[0].state, frame.fovea.eyes[1].state);
    const bool with_gaze =
        state == gaze::FoveaState::Tracking || state == gaze::FoveaState::OtherEye;
    if (!with_gaze) {
        const auto& eyes = frame.fovea.eyes;
        const gaze::FoveaPoint& worse = eyes[0].state >= eyes[1].state ? eyes[0] : eyes[1];
        ++counts_.lost;
        ++counts_.lost_by_reason[static_cast<std::size_t>(worse.reason)];
        ++counts_.lost_by_cause[static_cast<std::size_t>(worse.cause)];
        sequence_before_.reset();
        reuse_ = {};
        if (had_gaze_) {
            loss_.add(frame);
            loss_.keep_longest(counts_.longest_loss, now);
        } else {
            ++counts_.before_first;
        }
        return;
    }
    ++counts_.with_gaze;
    if (loss_.frames > 0) {
        // It ends here: as long as the longest, it lasted until now.
        if (loss_.first == counts_.longest_loss.first) {
            counts_.longest_loss.lasted = time::between(loss_.since, now);
        }
        loss_ = {};
    }
    had_gaze_ = true;
    const std::uint64_t sequence =
        frame.fovea.eyes[gaze::index(older_eye(frame.fovea))].sample_sequence;
    if (sequence_before_) {
        ++counts_.comparable;
        if (*sequence_before_ == sequence) {
            ++counts_.reused;
            reuse_.add(frame);
            reuse_.keep_longest(counts_.longest_reuse, now);
        } else {
            if (reuse_.frames > 1 && reuse_.first == counts_.longest_reuse.first) {
                counts_.longest_reuse.lasted = time::between(reuse_.since, now);
            }
            reuse_ = {};
            reuse_.add(frame);
        }
    } else {
        reuse_ = {};
        reuse_.add(frame);
    }
    sequence_before_ = sequence;
}

std::optional<double> expected_reuse_percent(double tracker_hz, double frames_hz) {
    if (!(tracker_hz > 0.0) || !(frames_hz > 0.0)) {
        return std::nullopt;
    }
    return 100.0 * std::max(0.0, 1.0 - tracker_hz / frames_hz);
}

}  // namespace gazeloop::latency
