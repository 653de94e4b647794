#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace gazeloop::report::perfetto {

/// What a group of tracks is about, in the order in which the tracks stand.
enum class Subject : std::uint8_t {
    GazeAge,   ///< a counter
    Interval,  ///< a counter
    Shaded,    ///< a counter
    LeftEye,   ///< what the fovea rests on
    RightEye,
    Tracker,
    Samples,
    Gaze,
    Loop,
    Gpu,
    Runtime,
    ScanOut,
    Light,
    Switching,
    Photon,
    Budget,
    GazeEvents,
    Events,
};
inline constexpr std::size_t kSubjects = 18;

struct SubjectText {
    std::string_view name;         ///< of its first track
    std::string_view description;  ///< shown where the track is selected
};

inline constexpr std::array<SubjectText, kSubjects> kSubjectTexts{{
    {"gaze age at display", "From the eye's exposure to the photon, at the photon's time."},
    {"frame interval", "From the wake-up of the frame before, at the frame's wake-up."},
    {"samples shaded", "Cells shaded on all grids, both eyes, at the frame's wake-up."},
    {"left eye", "What the left fovea rests on, from frame to frame, each at its latch."},
    {"right eye", "What the right fovea rests on, from frame to frame, each at its latch."},
    {"tracker",
     "Samples that frames rested on. tracker: the eye was seen, until the host could have had the "
     "sample at the earliest, or had it where that is unknown. delivery: until the host had it."},
    {"samples", "When the host had them; what was lost or out of order."},
    {"gaze", "queue: the host had the sample, until the frame's latch read it."},
    {"loop",
     "frame: wake_up to end_frame. In it, each part is named by the stamp at its end: begin, "
     "latch, filter, submit, end_frame."},
    {"gpu", "gpu: the first pass began, the last one ended. In it, the passes."},
    {"runtime",
     "present: from end_frame. display: from present, or end_frame where that is "
     "unknown, to the middle of the display's emission."},
    {"display: scan-out", "From the first row's emission to the last one's, from the profile."},
    {"display: light", "How long the row that is looked at is lit, from the profile."},
    {"display: switching", "Until the pixels of that row have switched, from the profile."},
    {"display: photon", "When the photons come of the row that is looked at."},
    {"budget", "When a latency budget is broken and kept again."},
    {"gaze events", "As the loop told them."},
    {"events", "As the run told them; frames that the recording lacks."},
}};

[[nodiscard]] constexpr const SubjectText& text_of(Subject subject) {
    return kSubjectTexts[static_cast<std::size_t>(subject)];
}

}  // namespace gazeloop::report::perfetto
