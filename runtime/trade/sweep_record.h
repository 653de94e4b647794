#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/error.h"
#include "runtime/quality/contrast_shares.h"
#include "runtime/quality/quality_totals.h"
#include "runtime/trade/sweep_points.h"

namespace gazeloop::trade {

/// Of a sweep: every n-th point, from `index` (from 0). Full resolution is part of all.
struct Shard {
    std::size_t index = 0;
    std::size_t count = 1;

    [[nodiscard]] bool has(std::size_t point) const { return point == 0 || point % count == index; }

    friend bool operator==(const Shard&, const Shard&) = default;
};

/// What all figures of a sweep rest on. Measurements under different ones are not comparable.
struct SweepSubject {
    std::string program{};  ///< version
    std::string device{};   ///< the Vulkan device's name
    std::string display{};
    std::string eye{};  ///< whose pictures are compared
    std::uint32_t width_px = 0;
    std::uint32_t height_px = 0;
    std::uint64_t frames = 0;
    double frame_seconds = 0.0;
    std::uint32_t samples = 0;            ///< per texel or pixel
    std::uint32_t reference_samples = 0;  ///< per pixel
    unsigned rounds = 0;                  ///< that are timed
    double peak_cd_m2 = 0.0;
    double black_cd_m2 = 0.0;
    std::vector<std::string> metrics{};
    /// The settings in force beside those that the points set, that are not built in: key, text.
    std::vector<std::pair<std::string, std::string>> settings{};

    friend bool operator==(const SweepSubject&, const SweepSubject&) = default;
};

/// One scene, seen along one gaze.
struct SweepCase {
    std::string scene;
    std::string gaze;  ///< as it was asked for
    /// That the comparison's acuity line asks for, both eyes, mean of the frames
    /// (foveation::fewest_samples).
    double fewest_cells = 0.0;

    friend bool operator==(const SweepCase&, const SweepCase&) = default;
};

/// What was found of a point's pictures in one case.
struct JudgedPoint {
    std::size_t of_case = 0;
    std::size_t point = 0;
    std::string error{};  ///< why it could not be rendered; all below is then empty
    double cells = 0.0;   ///< shaded per frame that was judged, both eyes
    std::vector<std::string> passes{};
    std::vector<quality::QualityFigure> figures{};
    std::string picture{};   ///< the last frame, small, a PNG in base64; empty: none kept
    std::string heat_map{};  ///< where it differs from the reference, likewise
    /// Of the reference, mean of the frames that were judged; with full resolution's point alone.
    std::optional<quality::ContrastShares> shares{};
    /// Of the reference's first frame; with full resolution's point alone. By it is known whether a
    /// scene, or the driver, is another one when the sweep goes on.
    std::optional<std::uint64_t> reference_hash{};
};

/// What each pass of a point took in one frame, ms, in the order of its passes; 0: did not run.
struct PointTime {
    std::size_t point = 0;
    std::vector<double> pass_ms{};
    /// What the processor took meanwhile, J, from the frame's beginning until all is done; none:
    /// unknown.
    std::optional<double> energy_j{};
    /// Views of a light field that the frame waited for before its passes began.
    std::uint64_t waited_views = 0;
};

/// One frame by all points in turns, of one machine.
struct TimedTurn {
    std::size_t of_case = 0;
    unsigned round = 0;
    std::size_t frame = 0;
    std::vector<PointTime> times{};
};

/// All that was measured so far. The first point is full resolution.
struct SweepRecord {
    SweepSubject subject;
    std::vector<SweepCase> cases;
    std::vector<SweepPoint> points;
    Shard shard{};  ///< which of them are measured here
    std::vector<JudgedPoint> judged{};
    std::vector<TimedTurn> turns{};
    /// Bytes at the end of its file that were cut short, as a killed program leaves them.
    std::size_t torn_bytes = 0;
};

/// "I/N" with I from 1 to N. Errors (Usage).
Expected<Shard> parse_shard(const std::string& text);

/// The records of one sweep's shards as one. Errors (Usage): no record; (BadInput): records of
/// different sweeps, two with the same shard. `names` stand for
/// the records in messages.
Expected<SweepRecord> merged(std::vector<SweepRecord> records,
                             const std::vector<std::string>& names);

/// In what two sweeps differ but for their shards, for people; empty: both measure the same.
[[nodiscard]] std::string difference_of(const SweepRecord& a, const SweepRecord& b);

}  // namespace gazeloop::trade
