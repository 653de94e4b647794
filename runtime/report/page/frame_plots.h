#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/report/frame_log.h"
#include "runtime/report/page/violations.h"

namespace gazeloop::report::page {

/// What a plot over time shows of a column in each bin.
enum class PlotForm : std::uint8_t {
    Envelope,  ///< the least and the greatest number: no spike is lost
    Mean,      ///< so that stages still add up
};

struct PlotSeries {
    std::string key;  ///< of the log's column
    PlotForm form = PlotForm::Envelope;
};

/// Frames that follow each other.
struct RowSpan {
    std::size_t first = 0;
    std::size_t end = 0;
};

/// Frames reduced to bins, as text for a script.
struct PackedBins {
    std::size_t bins = 0;
    std::string data{};  ///< see packed()
};

/// The frames of a session as its page carries them: all of them in bins of as many frames each as
/// the room allows (one, where it does), and every single frame around what is worth a look. The
/// script merges bins for every wider view.
///
/// Streams, of each bin one number, in this order: time (10 us after the first wake-up, or the row
/// where no frame knows its time), number of its first frame, its frames, frames whose foveae rest
/// on a fresh sample, by the other states held, returning, ahead, not rendered; of each limit the
/// judged frames above it; of each series in its order the mean, or the least and then greatest
/// less least. Durations in 10 us, angles in .001 degrees: a least one rounded down, a greatest up.
struct FramePlots {
    std::vector<PlotSeries> series;
    std::size_t limits = 0;
    std::int64_t end = 0;     ///< time of the last frame, as in the streams
    bool time_known = false;  ///< false: no frame knows when it woke up
    std::size_t rows = 0;     ///< of the session
    PackedBins all{};
    std::vector<RowSpan>
        spans{};          ///< in order, apart from each other; empty: `all` has every frame
    PackedBins single{};  ///< the frames of the spans, one after the other
};

/// At most so many characters each.
struct PlotRoom {
    std::size_t all = 3'000'000;
    std::size_t single = 600'000;
};

/// `of_note`: rows around which single frames are kept, the most important ones first, as far as
/// there is room. `limits` are in the streams in this order.
[[nodiscard]] FramePlots frame_plots(const FrameLog& frames, std::span<const Violations> limits,
                                     std::span<const std::size_t> of_note,
                                     const PlotRoom& room = {});

/// When the first frame woke up of those that say so; none: none does.
[[nodiscard]] std::optional<std::int64_t> first_wake_up_ns(const FrameLog& frames);

}  // namespace gazeloop::report::page
