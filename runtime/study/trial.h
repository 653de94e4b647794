#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace gazeloop::study {

enum class TrialKind : std::uint8_t {
    Training,  ///< not analysed
    Test,
    Validation,  ///< both pictures are the reference
};
inline constexpr std::array<std::string_view, 3> kTrialKindNames{"training", "test", "validation"};

/// One question to a subject.
struct Trial {
    unsigned number = 0;   ///< within the subject's study, from 0; a repeated trial keeps its own
    unsigned session = 0;  ///< from 0; training belongs to the first
    TrialKind kind = TrialKind::Test;
    /// A level of each factor. Of a validation trial: empty, but where the reference itself varies
    /// with scene or camera; the first one then says nothing. The first one of a Slider or of Quest
    /// is not planned: NaN.
    std::vector<double> levels{};
    /// The reference comes first; of a ramp: it begins there. A Slider always begins so.
    bool reference_first = true;

    friend bool operator==(const Trial&, const Trial&) = default;
};

enum class Answer : std::uint8_t {
    Same,
    Different,
    FirstBetter,
    SecondBetter,
    Up,
    Down,
    Equal,   ///< of a slider: this level, the first at which it was no longer raised
    Unable,  ///< of a slider: not even the best level equals the reference
};
inline constexpr std::array<std::string_view, 8> kAnswerNames{
    "same", "different", "first", "second", "up", "down", "equal", "unable"};

/// What spoils a trial.
enum class TrialFault : std::uint8_t { None, GazeLost, GazeOff };
inline constexpr std::array<std::string_view, 3> kTrialFaultNames{"none", "gaze-lost", "gaze-off"};

/// What a subject has answered to a trial.
struct Response {
    unsigned subject = 0;  ///< from 1; no names
    Trial trial;           ///< levels as they were shown
    unsigned attempt = 0;  ///< from 0: how often the trial was repeated before
    Answer answer = Answer::Same;
    double after_s = 0.0;  ///< from the end of what was shown to the answer; slider: of the trial
    TrialFault fault = TrialFault::None;
    std::optional<double> settled{};  ///< of a slider: the level at the end, after comparisons

    /// Whether it counts.
    [[nodiscard]] bool valid() const { return fault == TrialFault::None; }
};

}  // namespace gazeloop::study
