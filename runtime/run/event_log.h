#pragma once

#include <array>
#include <cstdint>

#include "runtime/frame/frame_observer.h"
#include "runtime/latency/happenings.h"

namespace gazeloop::run {

/// Says what happens as it happens, on the program's log: routine for who asks for it (debug), what
/// a user should know as its weight deserves. Of what happens again and again, three lines in ten
/// seconds; the next one says how many it stands for.
class EventLog final : public frame::FrameObserver {
  public:
    void on_event(time::Stamp time, std::string_view kind, std::string_view text) override;

  private:
    struct Said {
        std::int64_t window_begin_ns = 0;
        std::uint64_t in_window = 0;
        std::uint64_t unsaid = 0;  ///< since the last line
    };

    latency::Happenings happenings_;
    std::array<Said, latency::Happenings::kOthers + 1> said_;  ///< by their places
};

}  // namespace gazeloop::run
