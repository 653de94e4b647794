#include "runtime/study/trial_clock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/study/published_plans.h"
#include "runtime/study/responses_file.h"

namespace gazeloop::study {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kFrame = 10 * kMs;

Plan small_plan() {
    Plan plan = *published_plan("kfr-final");
    plan.factors[0].levels = {1.2, 2.4};
    plan.factors[1].levels = {1.0, 4.0};
    plan.sessions = 1;
    plan.training = 0;
    plan.validation = 0.0;
    plan.rest_s = 5.0;
    return plan;
}

/// A subject who looks at a clock's frames.
class Sitting {
  public:
    Sitting(const Plan& plan, unsigned subject, std::span<const Response> before = {})
        : queue(plan, subject), clock(plan, queue, subject) {
        resumed = queue.resume(before);
        clock.watch(now, Eyes::OnTarget);
    }
    /// Frame by frame until the screen is another; gives how long it was, in s.
    double pass(Screen screen) {
        const std::int64_t from = now;
        while (clock.at(now).screen == screen && now < from + 100'000 * kMs) {
            now += kFrame;
        }
        return static_cast<double>(now - from) * 1e-9;
    }
    void until(Screen screen) {
        for (int i = 0; i < 100'000 && clock.at(now).screen != screen; ++i) {
            now += kFrame;
        }
    }
    Response answer(Press press) {
        until(Screen::Question);
        EXPECT_TRUE(clock.press(now, press));
        const std::vector<Response> answers = clock.take_responses();
        EXPECT_EQ(answers.size(), 1U);
        return answers.at(0);
    }

    TrialQueue queue;
    TrialClock clock;
    Expected<void> resumed{};
    std::int64_t now = 1000 * kMs;
};

TEST(TrialClock, ShowsAPairAsLongAsThePlanSays) {
    const Plan plan = small_plan();
    Sitting sitting(plan, 1);
    const Trial trial = *sitting.queue.next();
    EXPECT_NEAR(sitting.pass(Screen::Black), 0.75, 0.011);
    const Shown first = sitting.clock.at(sitting.now);
    EXPECT_EQ(first.reference, trial.reference_first);
    EXPECT_NEAR(sitting.pass(Screen::Picture), 2.5, 0.011);
    EXPECT_NEAR(sitting.pass(Screen::Black), 0.75, 0.011);
    const Shown second = sitting.clock.at(sitting.now);
    EXPECT_NE(second.reference, trial.reference_first);
    EXPECT_EQ(second.reference ? first.level : second.level, trial.levels[0]);
    EXPECT_NEAR(sitting.pass(Screen::Picture), 2.5, 0.011);
    sitting.now += 1500 * kMs;
    EXPECT_EQ(sitting.clock.at(sitting.now).screen, Screen::Question);
    const Response response = sitting.answer(Press::Same);
    EXPECT_EQ(response.trial, trial);
    EXPECT_NEAR(response.after_s, 1.5, 0.011);
    EXPECT_TRUE(response.valid());
    EXPECT_EQ(sitting.clock.at(sitting.now).screen, Screen::Black);
}

TEST(TrialClock, RefusesWhatCannotBeAnswered) {
    const Plan plan = small_plan();
    Sitting sitting(plan, 1);
    const auto why = [&](Press press) {
        const auto pressed = sitting.clock.press(sitting.now, press);
        return pressed ? std::string("taken") : pressed.error().message;
    };
    EXPECT_THAT(why(Press::Same), HasSubstr("black"));
    sitting.until(Screen::Picture);
    EXPECT_THAT(why(Press::Same), HasSubstr("pictures are still being shown"));
    sitting.until(Screen::Question);
    EXPECT_THAT(why(Press::Up), HasSubstr("'up' answers no question"));
    EXPECT_THAT(why(Press::GoOn), HasSubstr("answers no question"));
    EXPECT_EQ(sitting.clock.refused(), 4U);
    EXPECT_TRUE(sitting.clock.take_responses().empty());
    EXPECT_EQ(why(Press::Different), "taken");
    EXPECT_EQ(sitting.clock.take_responses().size(), 1U);
    while (sitting.queue.next() != nullptr) {
        sitting.answer(Press::Same);
    }
    EXPECT_EQ(sitting.clock.at(sitting.now).screen, Screen::Over);
    EXPECT_THAT(why(Press::Same), HasSubstr("over"));
}

TEST(TrialClock, RestsAfterAFailedValidation) {
    Plan plan = small_plan();
    plan.validation = 0.5;
    Sitting sitting(plan, 2);
    while (sitting.queue.next()->kind != TrialKind::Validation) {
        sitting.answer(Press::Same);
    }
    const std::size_t left = sitting.queue.left();
    sitting.until(Screen::Picture);
    EXPECT_TRUE(sitting.clock.at(sitting.now).reference);
    sitting.answer(Press::Different);
    EXPECT_EQ(sitting.clock.at(sitting.now).screen, Screen::Rest);
    EXPECT_EQ(sitting.clock.rest(), Rest::FailedValidation);
    EXPECT_EQ(sitting.queue.left(), left - 1);  // answered, and not again
    const auto too_early = sitting.clock.press(sitting.now + 1000 * kMs, Press::GoOn);
    ASSERT_FALSE(too_early);
    EXPECT_THAT(too_early.error().message, HasSubstr("rest for another 4 s"));
    sitting.now += 5000 * kMs;
    EXPECT_EQ(sitting.clock.at(sitting.now).screen, Screen::Rest);
    EXPECT_TRUE(sitting.clock.press(sitting.now, Press::GoOn));
    EXPECT_EQ(sitting.clock.at(sitting.now).screen, Screen::Black);
}

TEST(TrialClock, RepeatsATrialThatTheEyesSpoilt) {
    const Plan plan = small_plan();
    for (const auto& [eyes, stretch_ms, fault] : {std::tuple{Eyes::Lost, 600, TrialFault::GazeLost},
                                                  {Eyes::Lost, 400, TrialFault::None},
                                                  {Eyes::Off, 350, TrialFault::GazeOff},
                                                  {Eyes::Off, 250, TrialFault::None}}) {
        Sitting sitting(plan, 1);
        const Trial trial = *sitting.queue.next();
        sitting.until(Screen::Picture);
        // Twice, with the eyes back in between: stretches are not added up.
        for (int times = 0; times < 2; ++times) {
            sitting.now += 100 * kMs;
            sitting.clock.watch(sitting.now, eyes);
            for (int ms = 0; ms < stretch_ms; ms += 10) {
                sitting.now += kFrame;
                (void)sitting.clock.at(sitting.now);
            }
            sitting.clock.watch(sitting.now, Eyes::OnTarget);
        }
        const Response response = sitting.answer(Press::Same);
        EXPECT_EQ(response.fault, fault);
        if (fault != TrialFault::None) {
            EXPECT_EQ(sitting.queue.left(), 4U);
            std::vector<unsigned> numbers;
            while (sitting.queue.next() != nullptr) {
                const unsigned attempt = sitting.queue.attempt();
                const Response next = sitting.answer(Press::Different);
                EXPECT_EQ(next.attempt, attempt);
                numbers.push_back(next.trial.number);
            }
            EXPECT_EQ(numbers, (std::vector<unsigned>{1, 2, 3, trial.number}));
        }
    }
}

TEST(TrialClock, GivesUpATrialThatIsAlwaysSpoilt) {
    const Plan plan = small_plan();
    Sitting sitting(plan, 1);
    sitting.clock.watch(sitting.now, Eyes::Lost);
    int answers = 0;
    while (sitting.queue.next() != nullptr && answers < 100) {
        EXPECT_FALSE(sitting.answer(Press::Same).valid());
        ++answers;
    }
    EXPECT_EQ(answers, 4 * 3);
    EXPECT_EQ(sitting.queue.given_up(), 4U);
}

TEST(TrialClock, LooksWithoutGazeAtAreNoMatterBetweenPictures) {
    const Plan plan = small_plan();
    Sitting sitting(plan, 1);
    sitting.clock.watch(sitting.now, Eyes::Lost);
    sitting.now += 700 * kMs;
    sitting.clock.watch(sitting.now, Eyes::OnTarget);
    EXPECT_TRUE(sitting.answer(Press::Same).valid());
}

TEST(TrialClock, BeginsATrialAgainAfterTheHeadsetWasOff) {
    const Plan plan = small_plan();
    Sitting sitting(plan, 1);
    sitting.until(Screen::Question);
    sitting.clock.wear(sitting.now, false);
    EXPECT_EQ(sitting.clock.at(sitting.now).screen, Screen::Away);
    EXPECT_THAT(sitting.clock.press(sitting.now, Press::Same).error().message,
                HasSubstr("headset is off"));
    sitting.now += 60'000 * kMs;
    sitting.clock.wear(sitting.now, true);
    EXPECT_NEAR(sitting.pass(Screen::Black), 0.75, 0.011);  // from its beginning
    EXPECT_EQ(sitting.clock.all_restarts(), 1U);
    const Response response = sitting.answer(Press::Same);
    EXPECT_EQ(response.trial.number, 0U);
    EXPECT_EQ(response.attempt, 0U);
}

TEST(TrialClock, BeginsATrialAgainWhosePictureNobodySaw) {
    const Plan plan = small_plan();
    Sitting sitting(plan, 1);
    sitting.until(Screen::Picture);
    sitting.now += 4000 * kMs;  // the machine slept: the second picture was never shown in time
    EXPECT_EQ(sitting.clock.at(sitting.now).screen, Screen::Picture);
    sitting.now += 9000 * kMs;
    EXPECT_EQ(sitting.clock.at(sitting.now).screen, Screen::Question);  // both were, if briefly
    Sitting other(plan, 1);
    other.until(Screen::Picture);
    other.now += 20'000 * kMs;
    EXPECT_EQ(other.clock.at(other.now).screen, Screen::Black);
    EXPECT_EQ(other.clock.restarts(), 1U);
    // Time that runs backward changes nothing.
    other.now -= 5000 * kMs;
    EXPECT_EQ(other.clock.at(other.now).screen, Screen::Black);
}

TEST(TrialQueue, GoesOnWhereItWasInterrupted) {
    for (const Design design : {Design::SameDifferent, Design::Quest}) {
        Plan plan = small_plan();
        plan.design = design;
        plan.factors[0].levels = {1.2, 1.4, 1.6, 1.8, 2.4};
        plan.repeats = design == Design::Quest ? 10 : 1;
        plan.validation = 0.2;
        plan.training = 2;
        plan.sessions = 2;
        const auto sit = [&](Sitting& sitting, std::size_t most) {
            std::vector<Response> all;
            while (sitting.queue.next() != nullptr && all.size() < most) {
                const unsigned number = sitting.queue.next()->number;
                sitting.clock.watch(sitting.now, number % 5 == 3 && sitting.queue.attempt() == 0
                                                     ? Eyes::Lost
                                                     : Eyes::OnTarget);
                all.push_back(sitting.answer(number % 3 == 0 ? Press::Same : Press::Different));
                if (sitting.clock.at(sitting.now).screen == Screen::Rest) {
                    sitting.now += 5000 * kMs;
                    EXPECT_TRUE(sitting.clock.press(sitting.now, Press::GoOn));
                }
            }
            return all;
        };
        Sitting whole(plan, 3);
        const std::vector<Response> expected = sit(whole, 1000);
        EXPECT_GT(expected.size(), 25U);
        for (const std::size_t cut : {std::size_t{0}, std::size_t{1}, std::size_t{11},
                                      expected.size() - 1, expected.size()}) {
            Sitting first(plan, 3);
            std::vector<Response> got = sit(first, cut);
            // What is kept is what a file holds.
            const auto kept = responses_of(plan, responses_csv(plan, got), "kept");
            ASSERT_TRUE(kept) << kept.error().message;
            Sitting second(plan, 3, *kept);
            ASSERT_TRUE(second.resumed) << second.resumed.error().message;
            for (const Response& response : sit(second, 1000)) {
                got.push_back(response);
            }
            ASSERT_EQ(got.size(), expected.size());
            for (std::size_t i = 0; i < got.size(); ++i) {
                EXPECT_EQ(got[i].trial, expected[i].trial);
                EXPECT_EQ(got[i].attempt, expected[i].attempt);
                EXPECT_EQ(got[i].answer, expected[i].answer);
            }
        }
        // Another subject's answers, or another plan's, are refused.
        Sitting other(plan, 4, expected);
        EXPECT_FALSE(other.resumed);
        plan.seed = 9;
        Sitting changed(plan, 3, expected);
        ASSERT_FALSE(changed.resumed);
        EXPECT_THAT(changed.resumed.error().message, HasSubstr("another plan"));
    }
}

TEST(TrialClock, TakesTheFirstStopOfASlider) {
    Plan plan = *published_plan("f3d-slider");
    plan.factors[1].levels = {1.0};
    plan.repeats = 1;
    Sitting sitting(plan, 1);
    sitting.until(Screen::Picture);
    EXPECT_TRUE(sitting.clock.at(sitting.now).reference);
    EXPECT_FALSE(sitting.clock.press(sitting.now, Press::Raise));
    sitting.now += 8000 * kMs;
    const auto press = [&](Press one) {
        sitting.now += 500 * kMs;
        EXPECT_TRUE(sitting.clock.press(sitting.now, one)) << static_cast<int>(one);
        return sitting.clock.at(sitting.now);
    };
    EXPECT_EQ(sitting.clock.at(sitting.now).level, 4.0);
    EXPECT_FALSE(sitting.clock.press(sitting.now, Press::Lower));
    EXPECT_EQ(press(Press::Raise).level, 5.0);
    EXPECT_EQ(press(Press::Raise).level, 6.0);
    EXPECT_TRUE(press(Press::Reference).reference);
    EXPECT_FALSE(press(Press::Reference).reference);
    EXPECT_EQ(press(Press::Raise).level, 7.0);
    press(Press::Done);
    const Response response = sitting.clock.take_responses().at(0);
    EXPECT_EQ(response.answer, Answer::Equal);
    EXPECT_EQ(response.trial.levels[0], 6.0);
    EXPECT_EQ(response.settled, 7.0);
}

TEST(TrialClock, RampsInStepsEitherWay) {
    const Plan& plan = *published_plan("f3d-ramp");
    Sitting sitting(plan, 1);
    for (int trials = 0; trials < 6; ++trials) {
        const Trial trial = *sitting.queue.next();
        std::vector<double> levels;
        while (sitting.clock.at(sitting.now).screen != Screen::Question) {
            sitting.pass(Screen::Black);
            levels.push_back(sitting.clock.at(sitting.now).level);
            EXPECT_NEAR(sitting.pass(Screen::Picture), 5.0, 0.011);
        }
        ASSERT_EQ(levels.size(), 5U);
        EXPECT_EQ(trial.reference_first ? levels.front() : levels.back(), 22.0);
        EXPECT_EQ(trial.reference_first ? levels.back() : levels.front(), trial.levels[0]);
        EXPECT_NEAR(levels[2], 0.5 * (22.0 + trial.levels[0]), 1e-12);
        sitting.answer(Press::Up);
    }
}

}  // namespace
}  // namespace gazeloop::study
