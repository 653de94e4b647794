#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "runtime/frame/frame_record.h"
#include "runtime/gaze/fovea_point.h"
#include "runtime/time/span.h"

namespace gazeloop::latency {

/// Where the time from the eye to the photon goes. Each stage begins where the one before ends, but
/// for Gpu: between the submit and the first pass nobody stamps anything, and that time is
/// unaccounted.
enum class Stage : std::size_t {
    Tracker,   ///< the eye was seen -> the host could have had the sample at the earliest
    Delivery,  ///< -> the host had it; where the earliest is unknown, Tracker has this time too
    Queue,     ///< -> the gaze was latched
    /// -> the foveae were computed; where that is unknown, Submit has this time too. And how much
    /// older the filtered gaze is than its newest sample.
    Filter,
    Submit,     ///< -> the last pass was handed to the GPU
    Gpu,        ///< the first pass began, after the submit or at it -> the last pass ended
    Present,    ///< -> the compositor presented it; where that is unknown, Wait has this time too
    Wait,       ///< -> the middle of the display's emission
    Row,        ///< -> the emission of the fovea's row, earlier above the middle; of the display
    Switching,  ///< -> the pixels have switched, a constant of the display
};
inline constexpr std::size_t kStageCount = 10;
inline constexpr std::array<std::string_view, kStageCount> kStageNames{
    "tracker",    "delivery",         "queue",       "filter",   "submit", "gpu",
    "compositor", "wait for display", "scan to row", "switching"};

/// Whether a stage is left out where it is unknown. These are Delivery, which is then part of
/// Tracker, Filter, which is then part of Submit, Present, which is then part of Wait, and Row,
/// because the summary says once that the display's lighting of rows is unknown.
[[nodiscard]] constexpr bool shown_only_if_known(std::size_t stage) {
    return stage == static_cast<std::size_t>(Stage::Delivery) ||
           stage == static_cast<std::size_t>(Stage::Filter) ||
           stage == static_cast<std::size_t>(Stage::Present) ||
           stage == static_cast<std::size_t>(Stage::Row);
}

/// When a frame came to light.
struct ShownFrame {
    time::Stamp at;
    std::uint64_t periods_missed = 0;  ///< display periods after the announced one, at least
    /// Whether it is known if the frame was shown as announced.
    bool in_time_known = false;
};

/// Where the runtime said when the frame was shown, then, and it missed as many periods as that is
/// later than announced, to the nearest. Else a model of the compositor: a frame whose last pass
/// ended by its announced display time is shown then. A later one is shown a whole number of
/// periods later, and marked as modelled (unknown without a period). If the end on the GPU is
/// unknown, the announced time stands.
[[nodiscard]] ShownFrame shown_frame(const frame::FrameStamps& stamps, std::int64_t period_ns);

/// How old the gaze was in one frame.
struct GazeAge {
    time::Span at_latch;  ///< sampled -> latch
    /// at_latch, had the gaze been read as the frame began: as old then, and older by the time from
    /// there to the latch. What latching late gains is the difference.
    time::Span read_at_begin;
    time::Span at_display;  ///< sampled -> shown, with the gaze filter's delay, and the display's
                            ///< row and switching times, if known
    /// Uncertainty of both ages, either way: from the tracker's fitted clock and its profile's
    /// delay.
    time::Span uncertainty;
    std::array<time::Span, kStageCount> stages;
    /// at_display less the known stages, exactly; known where at_display is. A stage with an
    /// unknown end leaves its time here.
    time::Span unaccounted;
};

/// `switching_ns` is the display profile's; `row_ns` is row_delay_ns of the row that is looked at.
[[nodiscard]] GazeAge gaze_age(const gaze::FoveaPoint& fovea, const frame::FrameStamps& stamps,
                               const time::Stamp& shown, std::optional<std::int64_t> switching_ns,
                               std::optional<std::int64_t> row_ns = std::nullopt);

/// From the middle of the emission to that of the row at `y_px` in a picture of `height_px`: (y /
/// height - 1/2) rolling. The first and the last row's emissions begin `rolling_ns` apart; 0: the
/// panel is lit at once. A row off screen counts as the nearest one. Unknown where rolling_ns is
/// unknown, or where the row is not a number.
[[nodiscard]] std::optional<std::int64_t> row_delay_ns(std::optional<std::int64_t> rolling_ns,
                                                       double y_px, std::uint32_t height_px);

/// Whether a display with this announced period can be the one with the profile's period: it shows
/// a new picture every time, or every second to fourth time. If not, the profile's figures of rows
/// and pixels are another display's.
[[nodiscard]] bool may_be_of_period(std::int64_t announced_ns, std::int64_t profile_ns);

/// The eye whose gaze is older, or of unknown age: a frame is as late as its later eye.
[[nodiscard]] gaze::Eye older_eye(const gaze::FrameFovea& fovea);

/// The age of the older gaze in a frame that was shown at `shown`, at the row where that eye looks.
/// The display profile's times as in gaze_age and row_delay_ns.
[[nodiscard]] GazeAge frame_gaze_age(const frame::FrameRecord& frame,
                                     const frame::FrameStamps& stamps, const time::Stamp& shown,
                                     std::optional<std::int64_t> switching_ns,
                                     std::optional<std::int64_t> rolling_ns);

}  // namespace gazeloop::latency
