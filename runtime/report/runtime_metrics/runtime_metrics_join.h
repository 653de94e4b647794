#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/frame/frame_observer.h"
#include "runtime/report/runtime_metrics/monado_frames.h"

namespace gazeloop::report {

/// What came of joining a session with the runtime's own metrics.
struct MetricsJoinCounts {
    std::uint64_t frames = 0;  ///< rendered
    std::array<std::uint64_t, kMonadoFateCount> by_fate{};
    std::uint64_t not_announced = 0;         ///< the runtime announced no display time of theirs
    std::uint64_t repeated = 0;              ///< shown more than once
    std::uint64_t compositor_late = 0;       ///< of modelled ones: the compositor itself was late
    std::optional<std::int64_t> first_ns{};  ///< the session's first and last wake_up
    std::optional<std::int64_t> last_ns{};

    [[nodiscard]] std::uint64_t of(MonadoFate fate) const {
        return by_fate[static_cast<std::size_t>(fate)];
    }
    /// Whose present and display were taken from the metrics.
    [[nodiscard]] std::uint64_t joined() const {
        return of(MonadoFate::Presented) + of(MonadoFate::Modelled);
    }
};

/// Tells other observers of a session with what Monado's metrics of the same run say of its frames.
/// A frame is the one of the same announced display time, to the nanosecond, since both write the
/// same clock. Then `present` and `shown` of its stamps become known. A frame that the compositor
/// never showed loses its display time. Other frames stay as they are, and are counted.
class RuntimeMetricsJoin final : public frame::FrameObserver {
  public:
    /// `observers` must outlive this.
    RuntimeMetricsJoin(MonadoMetricsReader file, std::span<frame::FrameObserver* const> observers)
        : frames_(std::move(file)), observers_(observers.begin(), observers.end()) {}

    void on_sample(const gaze::GazeSample& sample, std::uint64_t frame) override;
    void on_hidden(const gaze::HiddenChange& change) override;
    void on_origin(const gaze::OriginChange& change) override;
    void on_frame(const frame::FrameRecord& record) override;
    void on_gpu(const frame::FrameGpuRecord& record) override;
    void on_gaze(const frame::FrameGaze& gaze) override;
    void on_event(time::Stamp time, std::string_view kind, std::string_view text) override;

    [[nodiscard]] const MetricsJoinCounts& counts() const { return counts_; }
    [[nodiscard]] const MonadoFrames& frames() const { return frames_; }

    /// For the summary, lines of at most 100 columns.
    [[nodiscard]] std::string text() const;
    [[nodiscard]] nlohmann::ordered_json json() const;

  private:
    void join(frame::FrameRecord& record);

    MonadoFrames frames_;
    std::vector<frame::FrameObserver*> observers_;
    MetricsJoinCounts counts_;
};

}  // namespace gazeloop::report
