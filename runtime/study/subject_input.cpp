#include "runtime/study/subject_input.h"

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <cmath>
#include <optional>

#include "runtime/study/controls.h"
#include "runtime/study/simulated_person.h"

namespace gazeloop::study {
namespace {

class Person final : public PersonInput {
  public:
    explicit Person(Design design) : design_(design) {
        if (isatty(STDIN_FILENO) == 1 && tcgetattr(STDIN_FILENO, &before_.emplace()) == 0) {
            termios raw = *before_;
            raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
            tcsetattr(STDIN_FILENO, TCSANOW, &raw);
        } else {
            before_.reset();
        }
    }
    Person(const Person&) = delete;
    Person& operator=(const Person&) = delete;
    ~Person() override {
        if (before_) {
            tcsetattr(STDIN_FILENO, TCSANOW, &*before_);
        }
    }

    void listen_to(std::vector<present::ButtonSource*> sources) override {
        sources_ = std::move(sources);
    }

    std::vector<Press> presses(std::int64_t, const Shown& shown, const Trial*, unsigned) override {
        pressed_.clear();
        read_keys();
        for (present::ButtonSource* const source : sources_) {
            source->take(pressed_);
        }
        std::vector<Press> presses;
        for (const present::Pressed& one : pressed_) {
            const char* const key = std::get_if<char>(&one);
            const auto press =
                key != nullptr ? press_of(design_, *key)
                               : press_of(design_, std::get<present::Button>(one), shown.screen);
            if (press) {
                presses.push_back(*press);
            }
        }
        return presses;
    }

    [[nodiscard]] bool ended() const override { return !open_ && sources_.empty(); }

  private:
    void read_keys() {
        pollfd waiting{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
        while (open_ && poll(&waiting, 1, 0) > 0) {
            char key = 0;
            if (read(STDIN_FILENO, &key, 1) != 1) {
                open_ = false;  // nobody will press a key any more
                break;
            }
            pressed_.emplace_back(key);
        }
    }

    Design design_;
    std::vector<present::ButtonSource*> sources_;
    std::vector<present::Pressed> pressed_;
    std::optional<termios> before_;
    bool open_ = true;
};

class Simulated final : public SubjectInput {
  public:
    Simulated(const Plan& plan, const SimulatedPeople& people, unsigned subject)
        : plan_(plan), person_(plan, people, subject) {}

    std::vector<Press> presses(std::int64_t now_ns, const Shown& shown, const Trial* trial,
                               unsigned attempt) override {
        start_ns_ = start_ns_.value_or(now_ns);
        if (shown != shown_) {
            shown_ = shown;
            since_ns_ = now_ns;
            if (shown.screen == Screen::Picture && trial != nullptr && !slides(shown)) {
                person_.see(shown, *trial);
            }
        }
        const double seconds = static_cast<double>(now_ns - since_ns_) * 1e-9;
        if (shown.screen == Screen::Rest) {
            return seconds >= plan_.rest_s ? std::vector{Press::GoOn} : std::vector<Press>{};
        }
        if (trial == nullptr || seconds < plan_.answer_s ||
            (shown.screen != Screen::Question && !slides(shown))) {
            return {};
        }
        since_ns_ = now_ns;
        const double hours = static_cast<double>(now_ns - *start_ns_) / 3600e9;
        return {person_.answer(shown, *trial, attempt, hours)};
    }

  private:
    /// A slider's level, once its reference has been seen: after a black and a picture.
    [[nodiscard]] bool slides(const Shown& shown) const {
        return plan_.design == Design::Slider && shown.screen == Screen::Picture &&
               shown.part == (plan_.black_s > 0.0 ? 2U : 1U);
    }

    const Plan& plan_;
    SimulatedPerson person_;
    std::optional<Shown> shown_;
    std::int64_t since_ns_ = 0;
    std::optional<std::int64_t> start_ns_;
};

}  // namespace

std::unique_ptr<PersonInput> person_input(Design design) {
    return std::make_unique<Person>(design);
}

std::unique_ptr<SubjectInput> simulated_input(const Plan& plan, const SimulatedPeople& people,
                                              unsigned subject) {
    return std::make_unique<Simulated>(plan, people, subject);
}

}  // namespace gazeloop::study
