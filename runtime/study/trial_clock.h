#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/study/plan.h"
#include "runtime/study/trial_queue.h"

namespace gazeloop::study {

/// What a subject can press.
enum class Press : std::uint8_t {
    Same,
    Different,
    First,
    Second,
    Up,
    Down,
    Raise,  ///< of a slider, as the next four
    Lower,
    Reference,  ///< shows the reference, and the level again
    Done,
    Unable,
    GoOn,  ///< after a rest
};
inline constexpr std::array<std::string_view, 12> kPressNames{
    "same",  "different", "first",     "second", "up",     "down",
    "raise", "lower",     "reference", "done",   "unable", "go on"};

enum class Eyes : std::uint8_t { OnTarget, Off, Lost };

enum class Screen : std::uint8_t {
    Black,
    Picture,
    Question,  ///< black, until the answer comes
    Rest,
    Away,  ///< the headset is off
    Over,
};

/// What is on the display. Of a picture: the reference, or the trial with its first factor at
/// `level`.
struct Shown {
    Screen screen = Screen::Black;
    bool reference = true;
    double level = 0.0;
    unsigned part = 0;  ///< of the trial: pictures and blacks, from 0

    friend bool operator==(const Shown&, const Shown&) = default;
};

/// Takes a subject through the trials of a queue. Time is an argument, in ns on any line, and does
/// not run backward: an earlier one counts as the latest. A trial begins again when the headset was
/// taken off, or one of its pictures was never asked for while its time went by (the program or the
/// machine stood still); nothing of it had been answered.
class TrialClock {
  public:
    /// Both must outlive this.
    TrialClock(const Plan& plan, TrialQueue& queue, unsigned subject);

    /// What is to be shown now. Precondition for what follows: it has been called for each frame.
    [[nodiscard]] Shown at(std::int64_t now_ns);

    /// Errors (Usage), after which nothing has changed: why this press means nothing now.
    [[nodiscard]] Expected<void> press(std::int64_t now_ns, Press press);

    /// How the eyes are from now on; from the start they are lost.
    void watch(std::int64_t now_ns, Eyes eyes);
    void wear(std::int64_t now_ns, bool worn);

    /// When the screen of the last at() changes by itself; none: it waits for a press.
    [[nodiscard]] std::optional<std::int64_t> changes_ns() const;

    /// What has been answered since the last call.
    [[nodiscard]] std::vector<Response> take_responses() { return std::exchange(responses_, {}); }

    /// What the design's subject can press for an answer.
    [[nodiscard]] static std::vector<Press> presses(Design design);

    [[nodiscard]] Rest rest() const { return rest_; }
    /// How often the present trial has begun again; 0 after its answer.
    [[nodiscard]] unsigned restarts() const { return restarts_; }
    [[nodiscard]] unsigned all_restarts() const { return all_restarts_; }
    [[nodiscard]] unsigned refused() const { return refused_; }  ///< presses

  private:
    struct Part {
        Screen screen = Screen::Black;
        bool reference = true;
        double level = 0.0;
        std::int64_t length_ns = 0;
        bool seen = false;
    };

    void advance(std::int64_t now_ns);
    void count_eyes(std::int64_t from_ns, std::int64_t to_ns);
    void begin_trial(std::int64_t now_ns);
    void begin_again(std::int64_t now_ns);
    void add_part(Screen screen, double seconds, bool reference = true, double level = 0.0);
    void add_picture(bool reference, double level);
    [[nodiscard]] bool asking() const { return begun_ && part_ == parts_.size(); }
    [[nodiscard]] std::optional<std::string> why_not(Press press) const;
    void slide(Press press);
    void answer(Answer answer);
    [[nodiscard]] TrialFault fault() const;
    [[nodiscard]] double slider_level() const;

    const Plan* plan_;
    TrialQueue* queue_;
    unsigned subject_;
    std::int64_t now_ns_ = 0;
    bool any_time_ = false;
    bool worn_ = true;
    Eyes eyes_ = Eyes::Lost;
    Rest rest_ = Rest::None;
    std::int64_t rest_since_ns_ = 0;
    bool begun_ = false;  ///< the present trial
    std::vector<Part> parts_;
    std::size_t part_ = 0;  ///< parts_.size(): all were shown
    std::int64_t part_since_ns_ = 0;
    std::int64_t stretch_ns_ = 0;  ///< of pictures, with the eyes as they are
    std::int64_t longest_off_ns_ = 0;
    std::int64_t longest_lost_ns_ = 0;
    std::size_t slider_step_ = 0;  ///< from the worst level
    bool slider_reference_ = false;
    std::optional<double> first_stop_;
    unsigned restarts_ = 0;
    unsigned all_restarts_ = 0;
    unsigned refused_ = 0;
    std::vector<Response> responses_;
};

}  // namespace gazeloop::study
