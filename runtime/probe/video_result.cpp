#include "runtime/probe/video_result.h"

#include <fmt/core.h>

#include <cmath>
#include <utility>

#include "runtime/probe/frame_files.h"
#include "runtime/probe/frame_picture.h"

namespace gazeloop::probe {
namespace {

/// Below it a frame is as long as what is measured: half of what the instructions ask for.
constexpr double kLeastFps = 120.0;

struct FramesRead {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint64_t repeated = 0;
};

/// Reads every frame; the first one decides the size.
Expected<FramesRead> read_frames(
    const FrameFiles& files, const VideoQuestion& question, LightSeries& series,
    const std::function<void(std::uint64_t, std::uint64_t)>& progress) {
    FramesRead all;
    FramePicture picture;
    FramePicture before;
    for (std::uint64_t frame = 0; frame < files.count(); ++frame) {
        const std::filesystem::path file = files.file(frame);
        if (const auto read = picture.read(file); !read) {
            return std::unexpected(read.error());
        }
        if (frame == 0) {
            all = {.width = picture.width(), .height = picture.height()};
            for (const auto& [name, region] :
                 {std::pair{"lamp", &question.lamp}, std::pair{"patch", &question.patch}}) {
                if (const auto inside = check_inside(name, *region, all.width, all.height);
                    !inside) {
                    return std::unexpected(inside.error());
                }
            }
        } else if (picture.width() != all.width || picture.height() != all.height) {
            return std::unexpected(
                Error{ErrorKind::BadInput,
                      fmt::format("{}: has {}x{} pixels, {} before has {}x{}: the folder may hold "
                                  "the frames of one video alone",
                                  file.string(), picture.width(), picture.height(),
                                  files.file(0).filename().string(), all.width, all.height)});
        }
        series.add(static_cast<float>(picture.brightness(question.lamp)),
                   static_cast<float>(picture.brightness(question.patch)));
        if (progress) {
            progress(frame + 1, files.count());
        }
        all.repeated += frame > 0 && picture.same_as(before) ? 1 : 0;
        std::swap(picture, before);
    }
    return all;
}

/// Errors (Usage): what no camera and no picture can be.
Expected<void> check_question(const VideoQuestion& question) {
    const double frame_ms = 1e3 / question.camera_fps;
    if (question.readout_ms.value_or(0.0) > frame_ms) {
        return std::unexpected(Error{
            ErrorKind::Usage,
            fmt::format("--readout-ms {:g}: no camera reads a picture out for longer than the "
                        "{:.3g} ms from one to the next (--camera-fps {:g}): correct either, "
                        "or leave --readout-ms out",
                        *question.readout_ms, frame_ms, question.camera_fps)});
    }
    return check_regions_apart(question.lamp, question.patch);
}

/// What makes every delay too long or too short alike, milliseconds; says so.
double fixed_error_ms(VideoResult& result) {
    double fixed_ms = 0.0;
    const double rows_ms = std::abs(result.rows_below()) * result.frame_ms();
    if (!result.question.readout_ms && rows_ms > 0.0) {
        fixed_ms += rows_ms;
        result.warnings.push_back(fmt::format(
            "lamp and patch lie in different rows, which a rolling shutter exposes up to {:.2f} ms "
            "apart: mark them at one height, or say --readout-ms",
            rows_ms));
    }
    for (const auto& [name, light] :
         {std::pair{"lamp", &result.lamp}, std::pair{"patch", &result.patch}}) {
        if (light->levels.overexposed()) {
            fixed_ms += 0.5 * result.frame_ms();
            result.warnings.push_back(fmt::format(
                "the {} is overexposed, so that a part of its light looks like all of it: up to "
                "{:.2f} ms; mark its glow or a reflection, or expose less",
                name, 0.5 * result.frame_ms()));
        }
    }
    return fixed_ms;
}

DelayStatistics statistics_of(const VideoResult& result, bool on, double fixed_ms) {
    std::vector<double> delays_ms;
    for (const Trial& trial : result.paired.trials) {
        if (trial.on == on) {
            delays_ms.push_back(result.delay_ms(trial));
        }
    }
    return delay_statistics(delays_ms, {.frame_ms = result.frame_ms(),
                                        .rate_percent = result.question.fps_error_percent,
                                        .fixed_ms = fixed_ms});
}

}  // namespace

Expected<VideoResult> measure_series(const VideoQuestion& question, const LightSeries& series,
                                     std::uint32_t width, std::uint32_t height) {
    VideoResult result{
        .question = question, .frames = series.size(), .width = width, .height = height};
    for (const auto& [light, changes] :
         {std::pair{Light::Lamp, &result.lamp}, std::pair{Light::Patch, &result.patch}}) {
        auto found = find_changes(series, light, question.camera_fps);
        if (!found) {
            return std::unexpected(found.error());
        }
        *changes = *std::move(found);
    }
    result.paired = pair_changes(result.lamp.changes, result.patch.changes);
    if (question.camera_fps < kLeastFps) {
        result.warnings.push_back(
            fmt::format("a camera of {:g} frames per second leaves each delay uncertain by up to "
                        "{:.3g} ms: film at 240 or more",
                        question.camera_fps, result.frame_ms()));
    }
    const double fixed_ms = fixed_error_ms(result);
    result.on = statistics_of(result, true, fixed_ms);
    result.off = statistics_of(result, false, fixed_ms);
    return result;
}

Expected<VideoResult> measure_video(
    const VideoQuestion& question,
    const std::function<void(std::uint64_t, std::uint64_t)>& progress) {
    if (auto possible = check_question(question); !possible) {
        return std::unexpected(possible.error());
    }
    const auto files = FrameFiles::find(question.frames);
    if (!files) {
        return std::unexpected(files.error());
    }
    LightSeries series;
    const auto read = read_frames(*files, question, series, progress);
    if (!read) {
        return std::unexpected(read.error());
    }
    auto result = measure_series(question, series, read->width, read->height);
    if (result && read->repeated > 0) {
        result->repeated_frames = read->repeated;
        result->warnings.push_back(fmt::format(
            "{} of {} frames have every pixel of the one before, which no camera's noise does: a "
            "tool has filled the video to an even rate, and delays across these are too long; "
            "extract the frames with -fps_mode passthrough",
            read->repeated, result->frames));
    }
    return result;
}

}  // namespace gazeloop::probe
