#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "runtime/frame/frame_observer.h"
#include "runtime/latency/span_series.h"
#include "runtime/report/runtime_metrics/wivrn_frames.h"

namespace gazeloop::report {

/// A stage of WiVRn's, of all its video streams together or of one.
struct WivrnStage {
    std::string_view key;              ///< for programs
    std::string_view label;            ///< for people
    std::optional<WivrnEvent> from{};  ///< none: our end_frame
    WivrnEvent to = WivrnEvent::Begin;
    bool each_stream = true;  ///< whether it is told for each stream, too
};
inline constexpr std::array kWivrnStages{
    WivrnStage{"to_begin", "our end_frame -> begin", {}, WivrnEvent::Begin, false},
    WivrnStage{"to_encode", "begin -> encode", WivrnEvent::Begin, WivrnEvent::EncodeBegin},
    WivrnStage{"encode", "encode", WivrnEvent::EncodeBegin, WivrnEvent::EncodeEnd},
    WivrnStage{"send", "send", WivrnEvent::SendBegin, WivrnEvent::SendEnd},
    WivrnStage{"network", "send -> receive", WivrnEvent::SendBegin, WivrnEvent::ReceiveBegin},
    WivrnStage{"receive", "receive", WivrnEvent::ReceiveBegin, WivrnEvent::ReceiveEnd},
    WivrnStage{"to_decode", "receive -> decode", WivrnEvent::ReceiveEnd, WivrnEvent::DecodeBegin},
    WivrnStage{"decode", "decode", WivrnEvent::DecodeBegin, WivrnEvent::DecodeEnd},
    WivrnStage{"to_blit", "decode -> blit", WivrnEvent::DecodeEnd, WivrnEvent::Blit},
    WivrnStage{"to_display", "blit -> display", WivrnEvent::Blit, WivrnEvent::Display},
    WivrnStage{"whole", "our end_frame -> display", {}, WivrnEvent::Display, false}};

struct WivrnJoinCounts {
    std::uint64_t frames = 0;  ///< rendered
    std::uint64_t joined = 0;
    std::uint64_t not_announced = 0;  ///< no display time or no period was announced
    std::uint64_t missing = 0;        ///< no frame is displayed within half a period
    std::uint64_t taken = 0;          ///< the one that is belongs to an earlier frame
    std::uint64_t too_early = 0;      ///< the one that is was encoded before this one was submitted
    std::optional<std::int64_t> first_ns{};  ///< the session's first and last wake_up
    std::optional<std::int64_t> last_ns{};
};

/// Gathers what WiVRn's timing file says of a session's frames. The file does not name them, so a
/// frame is joined by its display time: with the frame of WiVRn's compositor whose first display in
/// the headset is nearest to the announced one, within half a period.
class WivrnStages final : public frame::FrameObserver {
  public:
    explicit WivrnStages(WivrnCsvReader file) : frames_(std::move(file)) {}

    /// Errors (SetupError): those of the file.
    void on_frame(const frame::FrameRecord& record) override;

    [[nodiscard]] const WivrnJoinCounts& counts() const { return counts_; }
    /// Of a stage of all streams together.
    [[nodiscard]] latency::DurationRow row(std::size_t stage) const {
        return together_[stage].row();
    }
    [[nodiscard]] latency::DurationRow row(std::size_t stage, std::size_t stream) const {
        return streams_[stream][stage].row();
    }
    /// The display in the headset less the announced one.
    [[nodiscard]] latency::DurationRow display_error() const { return display_error_.row(); }
    /// So many streams have values.
    [[nodiscard]] std::size_t streams() const;
    [[nodiscard]] const WivrnFrames& frames() const { return frames_; }

    /// For the summary, lines of at most 100 columns.
    [[nodiscard]] std::string text() const;
    [[nodiscard]] nlohmann::ordered_json json() const;

  private:
    using Series = std::array<latency::SpanSeries, kWivrnStages.size()>;

    [[nodiscard]] WivrnFrame* frame_of(const frame::FrameRecord& record);
    static void add(Series& series, const WivrnTimes& times, const time::Stamp& end_frame);

    WivrnFrames frames_;
    WivrnJoinCounts counts_;
    Series together_;
    std::array<Series, WivrnFrame::kMostStreams> streams_;
    latency::SpanSeries display_error_;
};

}  // namespace gazeloop::report
