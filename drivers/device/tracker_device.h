#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/device/device_feed.h"
#include "runtime/error.h"
#include "runtime/gaze/eye.h"
#include "runtime/time/clock_fit.h"

namespace gazeloop::drivers {

/// What a tracker says of itself; what it does not is absent.
struct TrackerFacts {
    std::optional<std::string> status;
    std::optional<std::uint32_t> sampling_hz;
    /// As in the EDID of the display that it is set up for: its gaze is wrong on any other display.
    std::optional<std::uint32_t> display_manufacturer;
    std::optional<std::uint32_t> display_product;
    std::optional<std::uint32_t> display_serial;
    std::optional<double> screen_width_m;  ///< that it is calibrated to
    std::optional<double> screen_height_m;
    std::optional<std::uint32_t> quality;  ///< on a scale of its own
    std::optional<double> minimum_distance_m;
    std::optional<double> optimum_distance_m;
    std::optional<double> maximum_distance_m;
    std::optional<double> maximum_screen_width_m;  ///< that it can track gaze on
    std::optional<double> maximum_screen_height_m;
    /// Feature reports that it gives no answer for, by id.
    std::vector<std::uint8_t> unanswered_reports;
    /// What its gaze needs to have a direction, and how to say it; none: nothing is missing.
    std::optional<std::string> missing;
};

/// What came from a tracker.
struct TrackerCounts {
    std::uint64_t reports = 0;  ///< everything that came
    std::uint64_t samples = 0;
    std::uint64_t damaged = 0;  ///< reports that were cut short or make no sense
    std::uint64_t others = 0;   ///< reports of something else
    std::uint64_t lost = 0;     ///< reports that were certainly lost on the way
};

/// The diameter of each pupil; none where the tracker has not said.
using PupilsMm = gaze::PerEye<std::optional<double>>;

/// A tracker that was opened and asked to send, read by one thread. The destructor stops it.
class TrackerDevice {
  public:
    virtual ~TrackerDevice() = default;

    /// "NAME (054c:0cde) at /dev/hidraw0".
    [[nodiscard]] virtual const std::string& text() const = 0;
    /// What it stated, and what keeps gaze from coming, one line each.
    [[nodiscard]] virtual const std::vector<std::string>& remarks() const = 0;
    [[nodiscard]] virtual TrackerFacts facts() const { return {}; }

    /// Waits for at most this long, and hands over what came. Errors (NoDevice): it was unplugged,
    /// or failed; it is of no further use then.
    [[nodiscard]] virtual Expected<void> read(std::chrono::milliseconds longest,
                                              DeviceFeed& feed) = 0;

    [[nodiscard]] virtual TrackerCounts counts() const = 0;
    /// Whether it was asked for something that it may still answer, or not answer at all.
    [[nodiscard]] virtual bool asking() const { return false; }
    /// What may keep one of its kind from sending, and where to look: "it may be ...".
    [[nodiscard]] virtual std::string_view why_silent() const = 0;
    /// As it was last seen.
    [[nodiscard]] virtual PupilsMm pupils_mm() const { return {}; }
    /// The fit of the samples' timestamps; null before the first, and for a tracker without
    /// timestamps.
    [[nodiscard]] virtual const time::ClockFit* clock() const = 0;

  protected:
    TrackerDevice() = default;
    TrackerDevice(const TrackerDevice&) = default;
    TrackerDevice& operator=(const TrackerDevice&) = default;
};

/// Whether the program ends: asked between two things that may take long.
using StopRequested = std::function<bool()>;

/// Opens a tracker of some kind: null where none is plugged in. Errors: one is, but it fails, or
/// the program ends (Interrupted).
using OpenTracker = std::function<Expected<std::unique_ptr<TrackerDevice>>(const StopRequested&)>;

/// How long the end of the program may wait for a silent tracker.
inline constexpr std::chrono::milliseconds kLongestRead{50};

}  // namespace gazeloop::drivers
