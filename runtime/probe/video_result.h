#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "runtime/error.h"
#include "runtime/probe/delay_statistics.h"
#include "runtime/probe/region.h"
#include "runtime/probe/trials.h"

namespace gazeloop::probe {

/// What the operator says of the camera and its picture.
struct VideoQuestion {
    std::filesystem::path frames;  ///< folder
    double camera_fps = 0.0;       ///< at which it was taken, whatever the video plays at
    double fps_error_percent = 0.0;
    /// From the first row's exposure to the last's; unknown: up to a whole frame.
    std::optional<double> readout_ms{};
    Region lamp;
    Region patch;
};

/// Eye-to-photon as a camera saw it.
struct VideoResult {
    VideoQuestion question;
    std::uint64_t frames = 0;
    /// Of them, those whose every pixel is as in the frame before: no camera's noise does that, but
    /// tools that fill a video to an even rate do.
    std::uint64_t repeated_frames = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    LightChanges lamp{};
    LightChanges patch{};
    PairedChanges paired{};
    DelayStatistics on{};   ///< the tracker lost the eye: eye-to-photon
    DelayStatistics off{};  ///< it found the eye again, which many trackers take longer for
    std::vector<std::string> warnings{};

    [[nodiscard]] double frame_ms() const { return 1e3 / question.camera_fps; }
    /// How many heights of the picture the patch lies below the lamp: a rolling shutter sees it
    /// later by this share of its readout.
    [[nodiscard]] double rows_below() const {
        return (question.patch.middle_row() - question.lamp.middle_row()) / height;
    }
    [[nodiscard]] double delay_ms(const Trial& trial) const {
        return trial.delay_frames() * frame_ms() + rows_below() * question.readout_ms.value_or(0.0);
    }
};

/// Reads the frames and measures. Errors (BadInput): see FrameFiles::find, FramePicture::read,
/// find_changes, and frames of different sizes (both named). Errors (Usage): a region outside the
/// frames, regions that overlap, a readout longer than a frame. Throws SetupError as LightSeries
/// does. `progress` is told the number of frames read and of all.
[[nodiscard]] Expected<VideoResult> measure_video(
    const VideoQuestion& question,
    const std::function<void(std::uint64_t, std::uint64_t)>& progress = {});

/// The same for what was read of frames of this size, none of them repeated.
[[nodiscard]] Expected<VideoResult> measure_series(const VideoQuestion& question,
                                                   const LightSeries& series, std::uint32_t width,
                                                   std::uint32_t height);

/// For people; lines end in newlines.
[[nodiscard]] std::string video_text(const VideoResult& result);
/// For programs, and for reports (measurement.h). null: unknown or withheld.
[[nodiscard]] nlohmann::ordered_json video_json(const VideoResult& result);

}  // namespace gazeloop::probe
