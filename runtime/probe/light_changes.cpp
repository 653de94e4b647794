#include "runtime/probe/light_changes.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace gazeloop::probe {
namespace {

constexpr std::array<std::string_view, kLightCount> kNames{"lamp", "patch"};

// Of the way from dark to bright. A pulse that two exposures share gives the brighter one half of
// its light, less what falls between them.
constexpr double kOn = 0.35;
constexpr double kOff = 0.2;
/// A ramp is over where this share or less is left.
constexpr double kRampEnd = 0.1;
/// No longer than this: a liquid crystal takes as much.
constexpr double kLongestRamp_s = 0.03;
/// If so many of the frames in which it is on are dark, the light is pulsed.
constexpr double kDarkWhilePulsed = 0.05;

/// Where a light is on: from the first frame above the threshold to the last.
struct OnRun {
    std::size_t first = 0;
    std::size_t last = 0;
    std::uint64_t dark = 0;    ///< frames between them that are below the lower threshold
    std::uint64_t pulses = 0;  ///< times that it rose
    bool from_start = false;   ///< on as the video began
    bool to_end = false;       ///< as it ended, or not off long enough to tell
};

class ChangeFinder {
  public:
    ChangeFinder(const LightSeries& series, Light light, double fps)
        : series_(series),
          light_(light),
          levels_(light_levels(series, light)),
          least_(std::max<std::size_t>(2, frames(kLeastState_s, fps))),
          ramp_(std::max<std::size_t>(1, frames(kLongestRamp_s, fps))) {}

    [[nodiscard]] const LightLevels& levels() const { return levels_; }

    [[nodiscard]] LightChanges find() const {
        LightChanges found;
        found.levels = levels_;
        const std::vector<OnRun> runs = on_runs(found.glitches);
        judge_pulses(runs, found);
        for (const OnRun& run : runs) {
            const std::optional<double> period = found.pulse_period_frames;
            if (!run.from_start) {
                found.changes.push_back(
                    {.on = true,
                     .frame = period ? end_pulse(run.first, -1, *period) : step_at(run.first, 1)});
            }
            if (!run.to_end) {
                found.changes.push_back({.on = false,
                                         .frame = period ? end_pulse(run.last, 1, *period) + *period
                                                         : step_at(run.last, -1)});
            }
        }
        return found;
    }

  private:
    static std::size_t frames(double seconds, double fps) {
        constexpr double kMost = 1e9;
        return static_cast<std::size_t>(std::ceil(std::min(seconds * fps, kMost)));
    }

    [[nodiscard]] double share(std::size_t frame) const {
        return levels_.share(series_.at(light_, frame));
    }

    /// Gaps shorter than the least state are bridged; runs shorter than it are glitches, unless the
    /// video cuts them.
    [[nodiscard]] std::vector<OnRun> on_runs(std::uint64_t& glitches) const {
        std::vector<OnRun> runs;
        std::optional<OnRun> run;
        std::uint64_t dark = 0;  // since the last frame above
        bool above = false;
        const auto close = [&](bool to_end) {
            run->to_end = to_end;
            if (run->last - run->first + 1 < least_ && !run->from_start && !to_end) {
                ++glitches;
            } else {
                runs.push_back(*run);
            }
            run.reset();
        };
        for (std::size_t frame = 0; frame < series_.size(); ++frame) {
            const double now = share(frame);
            const bool rises = !above && now > kOn;
            above = above ? now >= kOff : rises;
            if (run && now < kOff) {
                ++dark;
            }
            if (run && frame - run->last >= least_ && !above) {
                close(false);
            }
            if (!above) {
                continue;
            }
            if (!run) {
                run = OnRun{.first = frame, .from_start = frame < least_};
                dark = 0;
            }
            run->last = frame;
            run->dark += std::exchange(dark, 0);
            run->pulses += rises ? 1 : 0;
        }
        if (run) {
            close(true);
        }
        return runs;
    }

    /// The light is pulsed if it is dark again and again while it is on. The period is the mean of
    /// the runs whose own lies near their median: where two exposures share each pulse, pulses run
    /// into each other.
    static void judge_pulses(const std::vector<OnRun>& runs, LightChanges& found) {
        std::uint64_t on = 0;
        std::uint64_t dark = 0;
        std::vector<double> periods;
        for (const OnRun& run : runs) {
            on += run.last - run.first + 1;
            dark += run.dark;
            if (run.pulses > 1) {
                periods.push_back(static_cast<double>(run.last - run.first) /
                                  static_cast<double>(run.pulses - 1));
            }
        }
        found.pulsed = !periods.empty() &&
                       static_cast<double>(dark) > kDarkWhilePulsed * static_cast<double>(on);
        if (!found.pulsed) {
            return;
        }
        const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
        std::ranges::nth_element(periods, middle);
        const double median = *middle;
        double sum = 0.0;
        double count = 0.0;
        constexpr double kNear = 0.1;
        for (const double period : periods) {
            if (std::abs(period - median) <= kNear * median) {
                sum += period;
                count += 1.0;
            }
        }
        found.pulse_period_frames = sum / count;
    }

    /// When a steady light goes on (`brighter` = 1) at `frame`, or off (-1) after it: as far before
    /// the end of the ramp as the ramp's frames have light.
    [[nodiscard]] double step_at(std::size_t frame, int brighter) const {
        std::size_t bright = frame;
        for (std::size_t i = 0; i < ramp_ && share(bright) < 1.0 - kRampEnd; ++i) {
            const auto next = neighbour(bright, brighter);
            if (!next) {
                break;
            }
            bright = *next;
        }
        double light = share(bright);
        std::size_t at = bright;
        for (std::size_t i = 0; i < 2 * ramp_; ++i) {
            const auto next = neighbour(at, -brighter);
            if (!next) {
                break;
            }
            at = *next;
            light += share(at);
            if (share(at) <= kRampEnd) {
                break;
            }
        }
        return brighter > 0 ? static_cast<double>(bright + 1) - light
                            : static_cast<double>(bright) + light;
    }

    [[nodiscard]] std::optional<std::size_t> neighbour(std::size_t frame, int direction) const {
        if (direction > 0) {
            return frame + 1 < series_.size() ? std::optional(frame + 1) : std::nullopt;
        }
        return frame > 0 ? std::optional(frame - 1) : std::nullopt;
    }

    /// The middle of a run's first (`outward` = -1) or last (1) pulse. One beyond `frame`, the last
    /// that passed the threshold, counts where enough of it is seen.
    [[nodiscard]] double end_pulse(std::size_t frame, int outward, double period) const {
        const double middle = pulse_at(frame, -outward, period);
        const double beyond = middle - 0.5 + outward * period;
        if (beyond < 0.0 || beyond > static_cast<double>(series_.size() - 1)) {
            return middle;
        }
        std::size_t brightest = static_cast<std::size_t>(std::lround(beyond));
        for (const int direction : {-1, 1}) {
            const auto next = neighbour(static_cast<std::size_t>(std::lround(beyond)), direction);
            if (next && share(*next) > share(brightest)) {
                brightest = *next;
            }
        }
        constexpr double kNoises = 5.0;
        const double least =
            std::max(kRampEnd, kNoises * levels_.noise / (levels_.bright - levels_.dark));
        const bool seen = share(brightest) > least &&
                          std::abs(static_cast<double>(brightest) - (middle - 0.5)) > 0.5 * period;
        return seen ? pulse_at(brightest, -outward, period) : middle;
    }

    /// The middle of the pulse at `frame`; the run's others lie in the direction `inward`. No pulse
    /// is taken for longer than the period.
    [[nodiscard]] double pulse_at(std::size_t frame, int inward, double period) const {
        const auto longest = static_cast<std::size_t>(std::max(1.0, std::floor(period)));
        std::size_t begin = frame;
        for (std::size_t i = 1; i < longest; ++i) {
            const auto next = neighbour(begin, -inward);
            if (!next || share(*next) <= kRampEnd) {
                break;
            }
            begin = *next;
        }
        double light = 0.0;
        double moment = 0.0;
        std::optional<std::size_t> at = begin;
        for (std::size_t i = 0; i < longest && at && share(*at) > kRampEnd; ++i) {
            light += share(*at);
            moment += share(*at) * (static_cast<double>(*at) + 0.5);
            at = neighbour(*at, inward);
        }
        return moment / light;
    }

    const LightSeries& series_;
    Light light_;
    LightLevels levels_;
    std::size_t least_;  ///< frames
    std::size_t ramp_;   ///< frames
};

}  // namespace

Expected<LightChanges> find_changes(const LightSeries& series, Light light, double camera_fps) {
    const std::string_view name = kNames[static_cast<std::size_t>(light)];
    const ChangeFinder finder(series, light, camera_fps);
    const LightLevels& levels = finder.levels();
    if (!levels.apart()) {
        return std::unexpected(Error{
            ErrorKind::BadInput,
            fmt::format("--{}: its brightness stays between {:.3f} and {:.3f} of white (noise "
                        "{:.3f}) in all {} frames: no light is switched there; mark another region",
                        name, levels.dark, levels.bright, levels.noise, series.size())});
    }
    LightChanges found = finder.find();
    if (found.changes.empty()) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("--{}: its brightness changes, but never stays changed for {:.0f} ms "
                              "({} flashes in {} frames): mark another region, or switch the lamp "
                              "more slowly",
                              name, 1e3 * kLeastState_s, found.glitches, series.size())});
    }
    return found;
}

}  // namespace gazeloop::probe
