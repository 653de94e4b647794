#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "runtime/study/plan_file.h"
#include "runtime/study/published_plans.h"
#include "runtime/study/trial_order.h"

namespace gazeloop::study {
namespace {

using testing::HasSubstr;

TEST(PublishedPlans, AreThePapersNumbers) {
    const auto trials = [](const char* name, TrialKind kind) {
        const Plan& plan = *published_plan(name);
        unsigned count = 0;
        for (const Trial& trial : trials_of(plan, 1)) {
            count += trial.kind == kind ? 1 : 0;
        }
        return count;
    };
    for (const Plan& plan : published_plans()) {
        EXPECT_TRUE(check(plan)) << plan.name;
    }
    EXPECT_EQ(published_plan("kfr-pilot")->cells(), 56U);
    EXPECT_EQ(trials("kfr-pilot", TrialKind::Test), 3U * 56U);
    EXPECT_EQ(trials("kfr-pilot", TrialKind::Training), 20U);
    EXPECT_EQ(published_plan("kfr-final")->cells(), 28U);
    EXPECT_EQ(trials("kfr-final", TrialKind::Validation), 3U * 12U);  // 30 % of 40
    EXPECT_EQ(trials("f3d-pair", TrialKind::Test), 2U * 15U);
    EXPECT_EQ(trials("f3d-ramp", TrialKind::Test), 2U * 8U);
    EXPECT_EQ(trials("f3d-slider", TrialKind::Test), 16U);
    EXPECT_EQ(published_plan("none"), nullptr);
    // The paper's two pairs of index and slope.
    const Factor& quality = published_plan("f3d-pair")->factors.front();
    EXPECT_EQ(quality.value_of(12.0), "0.0275");
    EXPECT_EQ(quality.value_of(15.0), "0.022");
    EXPECT_EQ(published_plan("kfr-final")->factors.front().value_of(1.8), "1.8");
}

TEST(PlanFile, ReadsBackWhatItWrote) {
    for (Plan plan : published_plans()) {
        plan.source = "quotes \" and \\ and \x01";
        plan.settings.emplace_back("render.spp", "4");
        plan.factors.push_back({.name = "scene",
                                .key = "render.scene",
                                .levels = {1.0, 2.0},
                                .values = {"raymarch", "gallery"},
                                .by_session = true});
        plan.sessions = 2;
        plan.seed = 77;
        const std::string text = plan_text(plan);
        const auto again = plan_of(text, "plan.toml");
        ASSERT_TRUE(again) << again.error().message;
        EXPECT_EQ(plan_text(*again), text);
        EXPECT_EQ(trials_of(*again, 3).size(), trials_of(plan, 3).size());
    }
}

TEST(PlanFile, SaysWhatIsWrongAndWhere) {
    const std::string good = plan_text(*published_plan("kfr-final"));
    const auto message = [&](std::string_view from, std::string_view to) {
        std::string text = good;
        text.replace(text.find(from), from.size(), to);
        const auto plan = plan_of(text, "p.toml");
        return plan ? std::string("accepted") : plan.error().message;
    };
    EXPECT_THAT(message("design = \"2afc\"", "design = \"2acf\""),
                AllOf(HasSubstr("p.toml:6: "), HasSubstr("did you mean '2afc'")));
    EXPECT_THAT(message("black_s", "blakc_s"), HasSubstr("did you mean 'black_s'"));
    EXPECT_THAT(message("shown_s = 2.5", "shown_s = nan"), HasSubstr("shown_s is nan"));
    EXPECT_THAT(message("shown_s = 2.5", "shown_s = \"2.5\""), HasSubstr("must be a number"));
    EXPECT_THAT(message("sessions = 3", "sessions = -3"), HasSubstr("whole number"));
    EXPECT_THAT(message("sessions = 3", "sessions = 4000000000"), HasSubstr("sessions is 4e+09"));
    EXPECT_THAT(message("1.2, 1.4", "1.4, 1.2"), HasSubstr("levels must be numbers that rise"));
    EXPECT_THAT(
        message("version = 1", "version = 2"),
        AllOf(HasSubstr("p.toml:3: version = 2 is not known"), HasSubstr("reads version 1")));
    EXPECT_THAT(message("version = 1", ""), HasSubstr("version = 1 is missing"));
    EXPECT_THAT(message("gazeloop-study", "gazeloop"), HasSubstr("p.toml:2: is no study"));
    EXPECT_THAT(message("target_deg", "target_dge"), HasSubstr("did you mean 'gaze.target_deg'"));
    EXPECT_THAT(message("levels", "level"), HasSubstr("did you mean 'factor.levels'"));
    EXPECT_THAT(message("name = \"alpha\"", "name = \"sigma\""), HasSubstr("two factors"));
    EXPECT_THAT(message("key = \"kfr.sigma\"", "key = \"\""), HasSubstr("key is missing"));
    EXPECT_THAT(message("name = \"sigma\"", "by_session = true\nname = \"sigma\""),
                HasSubstr("judged within a session"));
    EXPECT_THAT(message("[gaze]", "[gaze"), HasSubstr("p.toml:"));
    EXPECT_THAT(message("validation = 0.3", "validation = 1.0"), HasSubstr("validation is 1"));
    EXPECT_FALSE(plan_of("", "p.toml"));
    EXPECT_FALSE(plan_of("format = 3", "p.toml"));
    EXPECT_THAT(read_plan("/nowhere/p.toml", nullptr).error().message, HasSubstr("No such file"));
}

TEST(PlanFile, TakesScenesForAFactorThatHasOneInASession) {
    std::string text = plan_text(*published_plan("kfr-final"));
    const std::string scenes = "scenes = [\"raymarch\", \"gallery\"]\n";
    const auto plan = plan_of(scenes + text, "p.toml");
    ASSERT_TRUE(plan) << plan.error().message;
    ASSERT_EQ(plan->factors.size(), 3U);
    EXPECT_EQ(plan->factors[2].value_of(2.0), "gallery");
    EXPECT_TRUE(plan->reference_varies());
    EXPECT_EQ(plan->cells_of_session(), 28U);
    const auto again = plan_of(plan_text(*plan), "p.toml");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(trials_of(*again, 4), trials_of(*plan, 4));
    // One session shows one of two.
    text.replace(text.find("sessions = 3"), 12, "sessions = 1");
    const auto few = plan_of(scenes + text, "p.toml");
    ASSERT_FALSE(few);
    EXPECT_THAT(few.error().message, AllOf(HasSubstr("sessions is 1, and 2 are needed"),
                                           HasSubstr("without by_session")));
}

TEST(TrialOrder, BalancesScenesOverSessionsAndSubjects) {
    Plan plan = *published_plan("kfr-final");
    plan.factors.push_back({.name = "scene",
                            .key = "render.scene",
                            .levels = {1.0, 2.0, 3.0},
                            .values = {"raymarch", "gallery", "other.gltf"},
                            .by_session = true});
    ASSERT_TRUE(check(plan));
    // Each scene at each place, and after each other, as often over six subjects.
    std::map<std::pair<unsigned, double>, unsigned> at_place;
    std::map<std::pair<double, double>, unsigned> after;
    for (unsigned subject = 1; subject <= 6; ++subject) {
        std::vector<double> of_session(3, 0.0);
        std::map<double, unsigned> shown;
        for (const Trial& trial : trials_of(plan, subject)) {
            ASSERT_EQ(trial.levels.size(), 3U);  // validation trials have a scene, too
            double& scene = of_session[trial.session];
            EXPECT_TRUE(scene == 0.0 || scene == trial.levels[2]);
            scene = trial.levels[2];
            shown[scene] += trial.kind == TrialKind::Test ? 1 : 0;
        }
        for (unsigned session = 0; session < 3; ++session) {
            ++at_place[{session, of_session[session]}];
            if (session > 0) {
                ++after[{of_session[session - 1], of_session[session]}];
            }
        }
        EXPECT_EQ(shown, (std::map<double, unsigned>{{1.0, 28}, {2.0, 28}, {3.0, 28}}));
    }
    EXPECT_EQ(at_place.size(), 9U);
    EXPECT_EQ(after.size(), 6U);
    for (const auto& [place, count] : at_place) {
        EXPECT_EQ(count, 2U);
    }
    for (const auto& [pair, count] : after) {
        EXPECT_EQ(count, 2U);
    }
    // Within a session all scenes, where none has one of its own.
    plan.factors[2].by_session = false;
    plan.sessions = 1;
    std::map<double, unsigned> validations;
    for (const Trial& trial : trials_of(plan, 1)) {
        if (trial.kind == TrialKind::Validation) {
            ++validations[trial.levels[2]];
        }
    }
    EXPECT_EQ(validations.size(), 3U);
}

TEST(WilliamsSquare, HasEachItemAtEachPlaceAndAfterEachOtherOnce) {
    for (const std::size_t n : {1U, 2U, 4U, 5U, 28U}) {
        const std::size_t rows = n % 2 == 0 ? n : 2 * n;
        std::vector<unsigned> places(n * n, 0);
        std::vector<unsigned> after(n * n, 0);
        for (std::size_t row = 0; row < rows; ++row) {
            const std::vector<std::size_t> list = williams_row(n, row);
            for (std::size_t at = 0; at < n; ++at) {
                ++places[list[at] * n + at];
                if (at > 0) {
                    ++after[list[at - 1] * n + list[at]];
                }
            }
        }
        const unsigned times = n % 2 == 0 ? 1 : 2;
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t k = 0; k < n; ++k) {
                EXPECT_EQ(places[i * n + k], times) << n;
                EXPECT_EQ(after[i * n + k], i == k ? 0 : times) << n;
            }
        }
    }
}

TEST(TrialOrder, IsBalancedOverSubjects) {
    Plan plan = *published_plan("kfr-final");
    plan.sessions = 1;
    std::vector<unsigned> reference_first(plan.cells(), 0);
    std::vector<unsigned> shown(plan.cells(), 0);
    for (unsigned subject = 1; subject <= 28; ++subject) {
        const std::vector<Trial> trials = trials_of(plan, subject);
        EXPECT_EQ(trials.size(), 5U + 40U);
        unsigned firsts = 0;
        for (const Trial& trial : trials) {
            if (trial.kind == TrialKind::Test) {
                const std::size_t cell = plan.factors[0].index_of(trial.levels[0]) * 4 +
                                         plan.factors[1].index_of(trial.levels[1]);
                ++shown[cell];
                reference_first[cell] += trial.reference_first ? 1 : 0;
                firsts += trial.reference_first ? 1 : 0;
            }
        }
        EXPECT_EQ(firsts, 14U);
    }
    for (std::size_t cell = 0; cell < plan.cells(); ++cell) {
        EXPECT_EQ(shown[cell], 28U);
        EXPECT_EQ(reference_first[cell], 14U);
    }
    EXPECT_EQ(trials_of(plan, 7), trials_of(plan, 7));
    EXPECT_NE(trials_of(plan, 7), trials_of(plan, 8));
}

}  // namespace
}  // namespace gazeloop::study
