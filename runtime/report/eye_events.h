#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "runtime/frame/frame_observer.h"
#include "runtime/gaze/events/eye_event.h"
#include "runtime/gaze/gaze_motion.h"

namespace gazeloop::report {

/// By whom it is known what the eyes did.
enum class EyeEventSource : std::uint8_t {
    None,
    Recorded,  ///< by the run itself (gaze.events, gaze.prediction, gaze.filter)
    Found,     ///< by the event detector, in the session's samples
};
inline constexpr std::array<std::string_view, 3> kEyeEventSourceNames{"none", "recorded", "found"};

/// What the eyes did in the course of a session. Where the run has classified it, that counts;
/// else what the event detector finds in the samples. A few bytes for each change.
class EyeEvents final : public frame::FrameObserver {
  public:
    /// An event holds from the sample that shows it until the next one; the last, for so long.
    static constexpr std::int64_t kNear_ns = 25'000'000;

    void on_sample(const gaze::GazeSample& sample, std::uint64_t frame) override;
    void on_origin(const gaze::OriginChange& change) override;
    void on_frame(const frame::FrameRecord& record) override;

    [[nodiscard]] EyeEventSource source() const;
    /// None: nobody knows.
    [[nodiscard]] std::optional<gaze::EyeEvent> at(std::int64_t time_ns) const;

  private:
    /// Changes in the order of their times.
    class Line {
      public:
        /// A time that is not after the one before is left out.
        void add(std::int64_t time_ns, gaze::EyeEvent event);
        [[nodiscard]] bool empty() const { return changes_.empty(); }
        [[nodiscard]] std::optional<gaze::EyeEvent> at(std::int64_t time_ns) const;

      private:
        struct Change {
            std::int64_t time_ns;
            gaze::EyeEvent event;
        };
        std::vector<Change> changes_;
        std::int64_t until_ns_ = 0;
    };

    gaze::GazeMotion motion_{{.tell_events = true}};
    Line recorded_;
    Line found_;
};

}  // namespace gazeloop::report
