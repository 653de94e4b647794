#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "runtime/gaze/fovea_point.h"
#include "runtime/latency/frame_record.h"
#include "runtime/latency/span.h"

namespace gazeloop::latency {

/// Where the time from the eye to the photon goes. Each stage begins where the one before ends.
enum class Stage : std::size_t {
    Tracker,    ///< the eye was seen -> the host had the sample
    Queue,      ///< -> the gaze was latched
    Submit,     ///< -> the last pass was handed to the GPU
    Gpu,        ///< -> the last pass ended
    Wait,       ///< -> the middle of the display's emission
    Switching,  ///< -> the pixels have switched, a constant of the display
};
inline constexpr std::size_t kStageCount = 6;
inline constexpr std::array<std::string_view, kStageCount> kStageNames{
    "tracker", "queue", "submit", "gpu", "wait for display", "switching"};

/// When a frame came to light.
struct ShownFrame {
    Stamp at;
    std::uint64_t periods_missed = 0;  ///< display periods after the announced one, at least
    bool in_time_known = false;        ///< whether the announced time and the GPU's end are known
};

/// A frame whose last pass ended by its announced display time is shown then. A later one is shown
/// a whole number of periods later, which is a model of the compositor, and marked so (unknown
/// without a period). With an unknown end on the GPU the announced time stands.
[[nodiscard]] ShownFrame shown_frame(const FrameStamps& stamps, std::int64_t period_ns);

/// How old the gaze was in one frame.
struct GazeAge {
    Span at_latch;    ///< sampled -> latch
    Span at_display;  ///< sampled -> shown, with the switching time where that is known
    std::array<Span, kStageCount> stages;
    /// at_display less the known stages, exactly; known where at_display is. A stage with an
    /// unknown end leaves its time here.
    Span unaccounted;
};

/// `switching_ns` is the display profile's.
[[nodiscard]] GazeAge gaze_age(const gaze::FoveaPoint& fovea, const FrameStamps& stamps,
                               const Stamp& shown, std::optional<std::int64_t> switching_ns);

/// The eye whose gaze is older, or of unknown age: a frame is as late as its later eye.
[[nodiscard]] const gaze::FoveaPoint& older_gaze(const gaze::FrameFovea& fovea);

}  // namespace gazeloop::latency
