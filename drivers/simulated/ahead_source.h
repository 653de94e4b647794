#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "drivers/gaze_source.h"
#include "runtime/periodic_thread.h"
#include "runtime/spsc_queue.h"

namespace gazeloop::drivers {

/// A source that computes its samples, by a thread of its own before they arrive: who polls it pays
/// for taking them alone. The samples are those of the source, at the same polls: one that nothing
/// is ready for computes them itself, as after a long pause. Only for sources whose samples depend
/// on nothing but time, and which tell no events; their head's motion is not told.
class AheadSource final : public GazeSource {
  public:
    explicit AheadSource(std::unique_ptr<GazeSource> source);

    /// By one thread at a time.
    void poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) override;
    [[nodiscard]] bool finished() const override { return finished_; }
    [[nodiscard]] std::string description() const override { return description_; }

  private:
    static constexpr std::int64_t kNever_ns = std::numeric_limits<std::int64_t>::min();

    void take_ready(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples);
    /// The source's samples until then. Under the mutex.
    void compute(std::int64_t until_ns);
    void publish_until();
    void work_ahead();

    std::string description_;
    SpscQueue<gaze::GazeSample> ready_;
    std::atomic<std::int64_t> ready_until_ns_{kNever_ns};  ///< all that arrives by then is there
    std::atomic<std::int64_t> asked_ns_{kNever_ns};        ///< of the last poll
    bool finished_ = false;

    std::mutex mutex_;
    std::unique_ptr<GazeSource> source_;
    std::int64_t computed_until_ns_ = kNever_ns;
    std::vector<gaze::GazeSample> over_;  ///< computed, and not in the queue, which is full

    std::optional<PeriodicThread> thread_;  // the first to end
};

}  // namespace gazeloop::drivers
