#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "drivers/gaze_source.h"
#include "runtime/openxr_layer/gaze_history.h"
#include "runtime/run/gaze_sources.h"

namespace gazeloop::openxr_layer {

/// A gaze source that any thread of the application may ask, and its last samples. A source that
/// fails is left alone from then on and said so once. A trace begins anew when it ends.
class GazeFeed {
  public:
    /// `name` is what the user called it. The source is made at the first take().
    GazeFeed(std::string name, run::MakeSource make, const HistoryPolicy& policy);

    /// Takes what has arrived by now, and calls `use(const GazeHistory&)` under the feed's lock.
    template <typename Use>
    auto take(std::int64_t now_ns, Use&& use) {
        const std::lock_guard lock(mutex_);
        poll(now_ns);
        return use(static_cast<const GazeHistory&>(history_));
    }

    /// The same with what has been taken before.
    template <typename Use>
    auto look(Use&& use) {
        const std::lock_guard lock(mutex_);
        return use(static_cast<const GazeHistory&>(history_));
    }

    /// Whether a tracker tracks, with or without an eye in sight: a sample came within the last
    /// second, and none after it says that the tracker is gone.
    [[nodiscard]] bool tracks(std::int64_t now_ns);

    [[nodiscard]] const std::string& name() const { return name_; }

  private:
    void poll(std::int64_t now_ns);
    void tell_events();

    std::string name_;
    run::MakeSource make_;
    std::mutex mutex_;
    std::unique_ptr<drivers::GazeSource> source_;
    std::vector<gaze::GazeSample> samples_;
    GazeHistory history_;
    /// Added to what a source counts, so that one that begins anew counts on.
    std::uint64_t sequence_offset_ = 0;
    std::int64_t last_arrival_ns_ = 0;
    bool failed_ = false;
};

}  // namespace gazeloop::openxr_layer
