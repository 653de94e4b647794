#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "runtime/gaze/events/recorded_events.h"
#include "runtime/gaze/sample_range.h"

namespace gazeloop::report::page {

/// What the samples of a bin show of an angle; empty: none has it.
struct AngleRange {
    double least_deg = std::numeric_limits<double>::infinity();
    double greatest_deg = -std::numeric_limits<double>::infinity();
    double sum_deg = 0.0;
    std::uint64_t count = 0;

    void add(double angle_deg);
    void add(const AngleRange& more);
};

/// Samples that follow each other.
struct GazeBin {
    double begin_s = 0.0;  ///< since the recording's first sample
    std::uint64_t first_sample = 0;
    std::uint64_t samples = 0;
    std::array<std::uint64_t, gaze::kEyeEventNames.size()> by_event{};  ///< samples
    std::array<AngleRange, 4> angles{};                                 ///< of each series
};

/// A recording reduced to bins, so that a page of any recording has a few megabytes at most.
struct GazeBins {
    std::array<std::string, 4> series{};
    double end_s = 0.0;
    std::vector<GazeBin> bins{};  ///< at most kMostBins
};
inline constexpr std::size_t kMostBins = 12'000;

/// Azimuth and elevation of both eyes in the head, of samples in the order of their times: as many
/// samples in each bin. Others are left out.
[[nodiscard]] GazeBins gaze_bins(const gaze::SampleRange& samples,
                                 std::span<const gaze::RecordedEvent> events);

/// Mean direction of the valid eyes of two recordings, the other one's `lag_ms` earlier, each from
/// its own first sample, over the time of the first: bins of equal lengths of time, in which each
/// recording has a sample or two at least.
[[nodiscard]] GazeBins compared_bins(const gaze::SampleRange& one, const gaze::SampleRange& other,
                                     double lag_ms);

/// At most so many bins, each of as many of those as the next.
[[nodiscard]] std::vector<GazeBin> in_parts(const GazeBins& bins, std::size_t most);

/// For page/levels.js: the streams that frame_plots.h describes, with samples for frames, events
/// for states, no limits, and the series as envelopes.
[[nodiscard]] nlohmann::ordered_json stream_json(const GazeBins& bins);

}  // namespace gazeloop::report::page
