#pragma once

#include <string>
#include <string_view>

#include "runtime/frame/event.h"
#include "runtime/frame/frame_observer.h"

namespace gazeloop::run {

/// Keeps why a tracker that is there cannot be used, until it gives a sample.
class TrackerFault final : public frame::FrameObserver {
  public:
    void on_event(time::Stamp, std::string_view kind, std::string_view text) override {
        if (kind == frame::kTrackerFaultEvent.name) {
            why_ = text;
        }
    }
    void on_sample(const gaze::GazeSample&, std::uint64_t) override { why_.clear(); }

    /// Empty: nothing was wrong, or gaze came after it.
    [[nodiscard]] const std::string& why() const { return why_; }

  private:
    std::string why_;
};

}  // namespace gazeloop::run
