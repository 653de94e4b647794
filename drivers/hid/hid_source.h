#pragma once

#include <memory>
#include <string>
#include <vector>

#include "drivers/gaze_source.h"
#include "drivers/hid/tracker_session.h"

namespace gazeloop::drivers::hid {

/// What top(1) calls the thread that reads.
inline constexpr const char* kHidThreadName = "gaze-hid";

/// Gaze of an eye tracker on HID usage page 0x12, which may come and go: a thread waits for it,
/// opens it, reads it, and waits again when it is gone. The gaze is directions in the head frame of
/// screen_gaze.h.
class HidSource final : public GazeSource {
  public:
    explicit HidSource(const HidOptions& options);
    ~HidSource() override;

    void poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) override;
    [[nodiscard]] std::vector<SourceEvent> take_events() override;
    [[nodiscard]] std::string description() const override;

    /// Samples lost because nobody polled for so long.
    [[nodiscard]] std::uint64_t dropped() const;

  private:
    class Reader;
    std::string path_;
    std::unique_ptr<Reader> reader_;
};

}  // namespace gazeloop::drivers::hid
