#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "runtime/fixed_text.h"
#include "runtime/frame/frame_observer.h"
#include "runtime/gaze/smoothing.h"
#include "runtime/latency/budget.h"
#include "runtime/latency/gaze_use.h"
#include "runtime/latency/latency_summary.h"
#include "runtime/latency/predicted_latency.h"
#include "runtime/named_value.h"

namespace gazeloop::report {

/// Where the gaze came from.
enum class GazeOrigin : std::uint8_t { Unknown, Tracker, Runtime, Simulated, Trace, Fixed };

/// By what the source says of itself (drivers::GazeSource::description).
[[nodiscard]] GazeOrigin origin_of(std::string_view description);

/// What is known of why the fovea lags. Everything but the settings is needed.
struct LagFacts {
    const latency::SummaryReport* report = nullptr;  ///< never null
    const latency::LatencyBudget* budget = nullptr;  ///< null: none was named
    GazeOrigin origin = GazeOrigin::Unknown;
    latency::PredictionCheck prediction{};
    latency::GazeUseCounts use{};
    gaze::SmoothingFinding smoothing{};
    std::string_view unplaced{};  ///< what gaze needs to have a direction; empty: nothing
    bool log_missing = false;     ///< of a session: its last part was not copied with it
    std::span<const NamedValue> settings{};  ///< of the run, as far as they are known
    std::span<const NamedValue> device{};    ///< likewise, as a session's table of that name

    /// Of the run; empty where it is not known.
    [[nodiscard]] std::string_view setting(std::string_view name) const;
    [[nodiscard]] std::string_view device_value(std::string_view name) const;
};

/// The stage that costs most, on average.
struct DearestStage {
    std::optional<latency::Stage> stage{};  ///< none: the time that nobody stamped
    double mean_ms = 0.0;
    double percent = 0.0;  ///< of the mean gaze age at display
};

/// None where the age of the gaze is unknown, or not above 0.
[[nodiscard]] std::optional<DearestStage> dearest_stage(const latency::SummaryReport& report);

/// "12.3 ms"; "0.04 ms" where tenths say nothing.
[[nodiscard]] std::string milliseconds_text(double ms);

/// What a report needs of a run beside its summary, gathered while it goes on or is played. In
/// fixed memory, without allocation after construction.
class LagObserver final : public frame::FrameObserver {
  public:
    void on_sample(const gaze::GazeSample& sample, std::uint64_t) override {
        smoothing_.add(sample);
    }
    void on_origin(const gaze::OriginChange&) override { smoothing_.move_origin(); }
    void on_frame(const frame::FrameRecord& frame) override { use_.add(frame); }
    /// There are more samples, which this is not told.
    void stop_samples() { smoothing_.stop(); }
    void on_event(time::Stamp, std::string_view kind, std::string_view text) override;

    [[nodiscard]] GazeOrigin origin() const { return origin_; }
    [[nodiscard]] const latency::GazeUseCounts& use() const { return use_.counts(); }
    [[nodiscard]] gaze::SmoothingFinding smoothing() const { return smoothing_.finding(); }
    [[nodiscard]] const FixedText<240>& unplaced() const { return unplaced_; }

  private:
    gaze::GazeSmoothing smoothing_;
    latency::GazeUse use_;
    GazeOrigin origin_ = GazeOrigin::Unknown;
    FixedText<240> unplaced_;  ///< kUnplacedGazeEvent's latest
};

}  // namespace gazeloop::report
