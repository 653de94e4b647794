#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/error.h"

namespace gazeloop::study {

/// How a study asks.
enum class Design : std::uint8_t {
    SameDifferent,  ///< a pair, reference and test in random order: same or different?
    Pair,           ///< both orders: the first better, the second better, or the same?
    Ramp,           ///< quality in steps to a level or from it: up, down, or the same?
    Slider,         ///< quality raised from the lowest level until it equals the reference
    Quest,          ///< as SameDifferent, each level where the answers so far say least
};
inline constexpr std::array<std::string_view, 5> kDesignNames{"2afc", "pair", "ramp", "slider",
                                                              "quest"};

/// What is varied. Levels are what figures show; what each sets is a text.
struct Factor {
    std::string name;            ///< one word
    std::string key;             ///< the setting; empty: a condition that sets nothing
    std::vector<double> levels;  ///< rising, finite
    /// What each level sets: these texts; without them quotient / level, if that is not 0; else the
    /// level itself.
    std::vector<std::string> values{};
    double quotient = 0.0;
    /// One level in a whole session, in turns that are balanced over subjects; else all in each.
    bool by_session = false;

    [[nodiscard]] std::string value_of(double level) const;
    [[nodiscard]] std::size_t index_of(double level) const;  ///< of the nearest level
};

/// Whether a setting is no method's, but decides pictures by any: of scene and camera. A reference
/// then has it too.
[[nodiscard]] bool is_of_all_methods(std::string_view key);

/// When the eyes spoil a trial.
struct GazeRules {
    double target_deg = 4.0;  ///< further from the target than this is off it
    double most_off_s =
        0.3;  ///< longer than this at a stretch, while pictures are shown, spoils it
    double most_lost_s = 0.5;    ///< likewise without gaze; a blink is shorter
    bool follow = false;         ///< foveae follow the gaze, which may be anywhere
    unsigned most_attempts = 3;  ///< then the trial is given up, and said to be
};

/// A study: everything that decides what a subject is shown.
struct Plan {
    std::string name;
    std::string source{};  ///< where the design comes from; may be empty
    Design design = Design::SameDifferent;
    std::string method = "kfr";
    std::string reference_method = "full";  ///< of a ramp: the method at its greatest level
    /// The first is the one whose threshold is asked; the last varies fastest.
    std::vector<Factor> factors;
    bool higher_is_better = false;  ///< a greater level of the first factor is nearer the reference
    bool logarithmic = true;        ///< thresholds are fitted over ln level
    double criterion = 0.5;         ///< share of yes (decisions.h) at the threshold
    std::vector<std::pair<std::string, std::string>> settings{};  ///< of all pictures
    unsigned subjects = 1;    ///< how many the study is meant for
    unsigned sessions = 1;    ///< each with all cells, of factors by session those of a level; rest
                              ///< in between
    unsigned repeats = 1;     ///< of each cell in a session; Quest: trials of a staircase
    unsigned training = 0;    ///< trials before the first session
    double validation = 0.0;  ///< share of trials whose pictures are equal, in [0, 0.9]
    double most_failed = 0.25;  ///< subjects who fail a larger share are left out
    double shown_s = 2.5;       ///< each picture
    double black_s = 0.75;      ///< before and between pictures
    double answer_s = 1.5;      ///< how long an answer is expected to take: for plans' length
    double rest_s = 30.0;       ///< at least, after a session or a failed validation
    unsigned steps = 5;         ///< of a ramp, >= 2
    GazeRules gaze{};
    std::uint64_t seed = 1;

    [[nodiscard]] std::size_t cells() const;  ///< combinations of levels
    /// Those of one session.
    [[nodiscard]] std::size_t cells_of_session() const;
    /// So many that each level of factors by session is shown.
    [[nodiscard]] unsigned least_sessions() const;
    /// Whether the reference of a trial depends on its levels.
    [[nodiscard]] bool reference_varies() const;
    /// Of all factors but the first.
    [[nodiscard]] std::size_t conditions() const;
    /// A level of each factor. Precondition: cell < cells().
    [[nodiscard]] std::vector<double> levels_of(std::size_t cell) const;
    /// The place of a threshold's fit on the axis of levels, and back.
    [[nodiscard]] double x_of(double level) const;
    [[nodiscard]] double level_at(double x) const;
};

inline constexpr std::size_t kMostCells = 10'000;
inline constexpr std::size_t kMostTrials = 100'000;

/// Whether it can be run at all. Errors (BadInput): key and remedy are named. What the settings
/// allow is checked by whoever has them.
[[nodiscard]] Expected<void> check(const Plan& plan);

}  // namespace gazeloop::study
