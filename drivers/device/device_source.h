#pragma once

#include <memory>
#include <string>
#include <vector>

#include "drivers/device/tracker_device.h"
#include "drivers/gaze_source.h"

namespace gazeloop::drivers {

/// Trackers of one kind.
struct DeviceKind {
    std::string subsystem;    ///< whose udev events say that one came; empty: none do
    std::string thread_name;  ///< for top(1), at most 15 characters
    std::string absence;      ///< what is said while none is plugged in
    OpenTracker open;
};

/// Gaze of a tracker that may come and go: a thread waits for it, opens it, reads it, and waits
/// again when it is gone.
class DeviceSource : public GazeSource {
  public:
    explicit DeviceSource(DeviceKind kind);
    ~DeviceSource() override;

    void poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) override;
    [[nodiscard]] std::vector<SourceEvent> take_events() override;

    /// Samples lost because nobody had polled for too long.
    [[nodiscard]] std::uint64_t dropped() const;

  private:
    class Reader;
    std::unique_ptr<Reader> reader_;
    std::uint64_t dropped_told_ = 0;
};

}  // namespace gazeloop::drivers
