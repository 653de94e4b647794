#include "runtime/report/page/frame_plots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "runtime/report/page/number_stream.h"
#include "runtime/report/row_names.h"
#include "runtime/time/span.h"

namespace gazeloop::report::page {
namespace {

constexpr std::int64_t kTick_ns = 10'000;
constexpr std::int64_t kTick_microdegrees = 1'000;
constexpr std::int64_t kMostScriptNumber = std::int64_t{1} << 53U;
constexpr std::size_t kMostBins = 1U << 17U;
constexpr std::size_t kNear = 90;  ///< frames before and after what is of note: a second or so
constexpr double kSparing = 0.95;  ///< of what should fit, because not all bins are alike

std::int64_t tick_of(Unit unit) {
    switch (unit) {
        case Unit::Nanoseconds:
            return kTick_ns;
        case Unit::Microdegrees:
            return kTick_microdegrees;
        case Unit::Count:
            break;
    }
    return 1;
}

std::int64_t rounded(std::int64_t number, std::int64_t tick) {
    return std::llround(static_cast<double>(number) / static_cast<double>(tick));
}

std::int64_t rounded_down(std::int64_t number, std::int64_t tick) {
    const std::int64_t whole = number / tick;
    return number % tick < 0 ? whole - 1 : whole;
}

std::int64_t rounded_up(std::int64_t number, std::int64_t tick) {
    const std::int64_t whole = number / tick;
    return number % tick > 0 ? whole + 1 : whole;
}

std::vector<PlotSeries> series_of(const FrameLog& frames) {
    std::vector<PlotSeries> series;
    const auto add = [&](const std::string& key, PlotForm form) {
        if (frames.at(key).known() > 0) {
            series.push_back({key, form});
        }
    };
    add(kGazeAgeAtDisplay.key, PlotForm::Envelope);
    add(kGazeAgeAtLatch.key, PlotForm::Envelope);
    for (std::size_t stage = 0; stage < latency::kStageCount; ++stage) {
        add(stage_name(stage).key, PlotForm::Mean);
    }
    add(kUnaccounted.key, PlotForm::Mean);
    add(kHeldGazeAge.key, PlotForm::Envelope);
    add(kGazeError.key, PlotForm::Envelope);
    add(kGazeErrorWithoutPoses.key, PlotForm::Envelope);
    add(kFrameInterval.key, PlotForm::Envelope);
    add(kLoopTime.key, PlotForm::Envelope);
    add(kGazeAgeUncertainty.key, PlotForm::Envelope);
    return series;
}

/// The time of each row on the plots' axis. It never goes back: a row whose time is unknown, or
/// before an earlier one's, has the greatest time before it.
class Times {
  public:
    explicit Times(const FrameLog& frames) : frames_(frames), first_ns_(first_wake_up_ns(frames)) {}

    [[nodiscard]] bool known() const { return first_ns_.has_value(); }
    /// Rows in their order.
    std::int64_t of(std::size_t row) {
        if (!first_ns_) {
            return static_cast<std::int64_t>(row);
        }
        for (; next_ <= row; ++next_) {
            if (const std::optional<std::int64_t> ns = frames_.wake_up_ns(next_)) {
                greatest_ = std::max(
                    greatest_, time::saturated(static_cast<__int128>(*ns) - *first_ns_) / kTick_ns);
            }
        }
        return greatest_;
    }

  private:
    const FrameLog& frames_;
    std::optional<std::int64_t> first_ns_;
    std::size_t next_ = 0;
    std::int64_t greatest_ = 0;
};

std::vector<RowSpan> even_bins(std::size_t rows, std::size_t count) {
    std::vector<RowSpan> bins;
    const std::size_t most = std::min(rows, count);
    bins.reserve(most);
    for (std::size_t i = 0; i < most; ++i) {
        bins.push_back({rows * i / most, rows * (i + 1) / most});
    }
    return bins;
}

std::vector<RowSpan> single_bins(std::span<const RowSpan> spans) {
    std::vector<RowSpan> bins;
    for (const RowSpan& span : spans) {
        for (std::size_t row = span.first; row < span.end; ++row) {
            bins.push_back({row, row + 1});
        }
    }
    return bins;
}

/// Writes the streams of one set of bins.
class Packer {
  public:
    Packer(const FrameLog& frames, std::span<const RowSpan> bins) : frames_(frames), bins_(bins) {}

    void add_frames() {
        Times times(frames_);
        each([&](const RowSpan& bin) { return times.of(bin.first); });
        each([&](const RowSpan& bin) {
            return static_cast<std::int64_t>(std::min<std::uint64_t>(
                frames_.number(bin.first), static_cast<std::uint64_t>(kMostScriptNumber)));
        });
        each([](const RowSpan& bin) { return static_cast<std::int64_t>(bin.end - bin.first); });
    }

    void add_states() {
        using enum gaze::FoveaState;
        count([&](std::size_t row) {
            const auto state = frames_.state(row);
            return state == Tracking || state == OtherEye;
        });
        for (const gaze::FoveaState wanted : {Held, Returning, Ahead}) {
            count([&](std::size_t row) { return frames_.state(row) == wanted; });
        }
        count([&](std::size_t row) { return !frames_.state(row); });
    }

    void add_above(const Violations& limit) {
        count([&](std::size_t row) {
            const std::optional<std::int64_t> number = limit.column->at(row);
            return number && *number > limit.limit;
        });
    }

    void add_means(const DurationColumn& column) {
        const std::int64_t tick = tick_of(column.unit());
        each([&](const RowSpan& bin) -> std::optional<std::int64_t> {
            __int128 sum = 0;
            std::int64_t known = 0;
            for (std::size_t row = bin.first; row < bin.end; ++row) {
                if (const std::optional<std::int64_t> number = column.at(row)) {
                    sum += *number;
                    ++known;
                }
            }
            return known > 0 ? std::optional(rounded(static_cast<std::int64_t>(sum / known), tick))
                             : std::nullopt;
        });
    }

    void add_envelope(const DurationColumn& column) {
        const std::int64_t tick = tick_of(column.unit());
        std::vector<std::optional<std::int64_t>> heights;
        heights.reserve(bins_.size());
        each([&](const RowSpan& bin) -> std::optional<std::int64_t> {
            std::optional<std::int64_t> least;
            std::optional<std::int64_t> greatest;
            for (std::size_t row = bin.first; row < bin.end; ++row) {
                if (const std::optional<std::int64_t> number = column.at(row)) {
                    least = std::min(least.value_or(*number), *number);
                    greatest = std::max(greatest.value_or(*number), *number);
                }
            }
            if (!least || !greatest) {
                heights.emplace_back(std::nullopt);
                return std::nullopt;
            }
            const bool one = *least == *greatest;
            const std::int64_t down = one ? rounded(*least, tick) : rounded_down(*least, tick);
            heights.emplace_back(one ? 0 : rounded_up(*greatest, tick) - down);
            return down;
        });
        stream_.begin_series();
        std::ranges::for_each(heights, [this](const auto& height) { stream_.add(height); });
    }

    [[nodiscard]] PackedBins packed_bins() const { return {bins_.size(), packed(stream_.bytes())}; }

  private:
    void each(const auto& number_of) {
        stream_.begin_series();
        for (const RowSpan& bin : bins_) {
            stream_.add(number_of(bin));
        }
    }

    void count(const auto& counts) {
        each([&](const RowSpan& bin) {
            std::int64_t rows = 0;
            for (std::size_t row = bin.first; row < bin.end; ++row) {
                rows += counts(row) ? 1 : 0;
            }
            return rows;
        });
    }

    const FrameLog& frames_;
    std::span<const RowSpan> bins_;
    NumberStream stream_;
};

PackedBins packed_bins(const FrameLog& frames, std::span<const PlotSeries> series,
                       std::span<const Violations> limits, std::span<const RowSpan> bins) {
    Packer packer(frames, bins);
    packer.add_frames();
    packer.add_states();
    for (const Violations& limit : limits) {
        packer.add_above(limit);
    }
    for (const PlotSeries& one : series) {
        if (one.form == PlotForm::Mean) {
            packer.add_means(frames.at(one.key));
        } else {
            packer.add_envelope(frames.at(one.key));
        }
    }
    return packer.packed_bins();
}

/// The rows near those of note, as many as `most`, apart from each other and in order.
std::vector<RowSpan> spans_near(std::span<const std::size_t> of_note, std::size_t rows,
                                std::size_t most) {
    std::vector<RowSpan> near;
    std::size_t kept = 0;
    for (const std::size_t row : of_note) {
        const RowSpan span{row - std::min(row, kNear), std::min(rows, row + kNear + 1)};
        if (kept + (span.end - span.first) > most) {
            break;
        }
        kept += span.end - span.first;
        near.push_back(span);
    }
    std::ranges::sort(near, {}, &RowSpan::first);
    std::vector<RowSpan> spans;
    for (const RowSpan& span : near) {
        if (!spans.empty() && span.first <= spans.back().end) {
            spans.back().end = std::max(spans.back().end, span.end);
        } else {
            spans.push_back(span);
        }
    }
    return spans;
}

std::size_t that_fit(const PackedBins& tried, std::size_t room) {
    const double share = static_cast<double>(room) / static_cast<double>(tried.data.size());
    return static_cast<std::size_t>(static_cast<double>(tried.bins) * share * kSparing);
}

}  // namespace

std::optional<std::int64_t> first_wake_up_ns(const FrameLog& frames) {
    for (std::size_t row = 0; row < frames.rows(); ++row) {
        if (const std::optional<std::int64_t> ns = frames.wake_up_ns(row)) {
            return ns;
        }
    }
    return std::nullopt;
}

FramePlots frame_plots(const FrameLog& frames, std::span<const Violations> limits,
                       std::span<const std::size_t> of_note, const PlotRoom& room) {
    FramePlots plots{.series = series_of(frames), .limits = limits.size(), .rows = frames.rows()};
    if (frames.rows() == 0) {
        return plots;
    }
    Times times(frames);
    plots.time_known = times.known();
    plots.end = times.of(frames.rows() - 1);
    const auto pack = [&](std::span<const RowSpan> bins) {
        return packed_bins(frames, plots.series, limits, bins);
    };
    plots.all = pack(even_bins(frames.rows(), kMostBins));
    while (plots.all.data.size() > room.all && plots.all.bins > 1) {
        plots.all =
            pack(even_bins(frames.rows(), std::max<std::size_t>(1, that_fit(plots.all, room.all))));
    }
    if (plots.all.bins == frames.rows()) {
        return plots;
    }
    std::size_t most = that_fit(plots.all, room.single);
    for (;;) {
        plots.spans = spans_near(of_note, frames.rows(), most);
        plots.single = pack(single_bins(plots.spans));
        if (plots.single.data.size() <= room.single || plots.spans.empty()) {
            return plots;
        }
        most = std::min(most / 2, that_fit(plots.single, room.single));
    }
}

}  // namespace gazeloop::report::page
