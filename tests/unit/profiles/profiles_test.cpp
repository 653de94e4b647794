#include "runtime/profiles/profiles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/trigonometric.hpp>

#include "config/built_in_files.h"
#include "runtime/profiles/profiles_in_force.h"
#include "sim/simulation_settings.h"
#include "tests/support/run_program.h"

namespace gazeloop::profiles {
namespace {

using testing::HasSubstr;

constexpr const char* kDisplay =
    "width_px = 64\nheight_px = 64\nrefresh_hz = 100\n[fov_deg]\nleft = [-40, 40, 40, -40]\n"
    "right = [-40, 40, 40, -40]\n[optics]\nipd_mm = 63\n";

std::string refusal(const tests::ScratchFolder& folder, const std::string& text) {
    const auto loaded = load_display(folder.write("display.toml", text));
    EXPECT_FALSE(loaded.has_value());
    return loaded ? "" : loaded.error().message;
}

TEST(Profiles, BuiltInOnesAreComplete) {
    std::size_t displays = 0;
    std::size_t trackers = 0;
    std::size_t budgets = 0;
    for (const config::BuiltInFile& file : config::built_in_files()) {
        if (file.folder == "displays") {
            ++displays;
            const auto display = load_display(file.name);
            ASSERT_TRUE(display.has_value()) << display.error().message;
            EXPECT_FALSE(display->description.empty()) << file.name;
            EXPECT_TRUE(display->illumination && display->persistence_ns && display->scan_out_ns &&
                        display->switching_ns)
                << file.name;
            EXPECT_TRUE(display->rolling_ns().has_value());
            // What no maker publishes is never passed off as published.
            EXPECT_THAT(display->assumed, testing::Contains("optics.ipd_mm")) << file.name;
        } else if (file.folder == "trackers") {
            ++trackers;
            const auto tracker = load_tracker(file.name);
            ASSERT_TRUE(tracker.has_value()) << tracker.error().message;
            EXPECT_GT(tracker->delay_ns, 0) << file.name;
            EXPECT_GE(tracker->terms.size(), 4U) << file.name;
        } else if (file.folder == "budgets") {
            ++budgets;
            const auto budget = load_budget(file.name);
            ASSERT_TRUE(budget.has_value()) << budget.error().message;
            EXPECT_EQ(budget->name, file.name);
            EXPECT_FALSE(budget->description.empty() || budget->source.empty()) << file.name;
            EXPECT_TRUE(budget->total_ns.has_value()) << file.name;
        }
    }
    EXPECT_GE(budgets, 6U);
    EXPECT_GE(displays, 7U);
    EXPECT_GE(trackers, 6U);
}

// Held against the sources that the files name; a slip of the pen shows here.
TEST(Profiles, HaveTheFiguresOfTheirSources) {
    struct Figures {
        const char* name;
        std::uint32_t width_px;
        std::uint32_t height_px;
        double refresh_hz;
        gaze::PerEye<std::array<double, 4>> fov_deg;  ///< left, right, up, down
    };
    constexpr Figures kFigures[] = {
        {"fove0", 1280, 1440, 70.0, {{{-50.0, 50.0, 50.0, -50.0}, {-50.0, 50.0, 50.0, -50.0}}}},
        {"f3d_monitor",
         1920,
         1080,
         120.0,
         {{{-23.37, 23.37, 13.67, -13.67}, {-23.37, 23.37, 13.67, -13.67}}}},
        {"generic_2160",
         2160,
         2160,
         90.0,
         {{{-52.0, 48.0, 50.0, -50.0}, {-48.0, 52.0, 50.0, -50.0}}}},
        {"psvr2",
         2000,
         2040,
         120.0,
         {{{-61.5, 43.45, 53.04, -53.04}, {-43.45, 61.5, 53.04, -53.04}}}},
        {"quest_pro", 1800, 1920, 90.0, {{{-54.0, 40.0, 42.0, -54.0}, {-40.0, 54.0, 42.0, -54.0}}}},
        {"varjo_xr4",
         3840,
         3744,
         90.0,
         {{{-57.14, 45.19, 51.53, -51.76}, {-45.19, 57.14, 51.53, -51.76}}}},
        {"vive_pro_eye",
         1440,
         1600,
         90.0,
         {{{-53.57, 50.41, 54.99, -54.91}, {-50.38, 53.64, 54.92, -54.98}}}}};
    for (const Figures& figures : kFigures) {
        const auto display = load_display(figures.name);
        ASSERT_TRUE(display.has_value()) << figures.name;
        EXPECT_EQ(display->width_px, figures.width_px) << figures.name;
        EXPECT_EQ(display->height_px, figures.height_px) << figures.name;
        EXPECT_DOUBLE_EQ(display->refresh_hz, figures.refresh_hz) << figures.name;
        for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
            const gaze::FieldOfView& fov = display->fov[eye];
            const auto& [left, right, up, down] = figures.fov_deg[eye];
            EXPECT_DOUBLE_EQ(fov.left_rad, glm::radians(left)) << figures.name;
            EXPECT_DOUBLE_EQ(fov.right_rad, glm::radians(right)) << figures.name;
            EXPECT_DOUBLE_EQ(fov.up_rad, glm::radians(up)) << figures.name;
            EXPECT_DOUBLE_EQ(fov.down_rad, glm::radians(down)) << figures.name;
        }
    }
}

TEST(Profiles, KnowTheCantingOfTheValveIndex) {
    const auto index = load_display("valve_index");
    ASSERT_TRUE(index.has_value());
    EXPECT_DOUBLE_EQ(index->cant_outward_rad[0], glm::radians(5.0));
    EXPECT_DOUBLE_EQ(index->cant_outward_rad[1], glm::radians(5.0));
    EXPECT_EQ(index->illumination, display::Illumination::Global);
}

TEST(Profiles, LeaveUnsaidFiguresUnknown) {
    const tests::ScratchFolder folder;
    const auto display = load_display(folder.write("plain.toml", kDisplay));
    ASSERT_TRUE(display.has_value()) << display.error().message;
    EXPECT_FALSE(display->illumination || display->persistence_ns || display->scan_out_ns ||
                 display->switching_ns);
    EXPECT_EQ(display->cant_outward_rad[0], 0.0);
}

TEST(Profiles, RefuseWhatTheyDoNotKnow) {
    const tests::ScratchFolder folder;
    const std::string good = kDisplay;
    EXPECT_THAT(refusal(folder, good + "cant_outwards_deg = [1, 1]\n"),
                testing::AllOf(HasSubstr("display.toml:9"),
                               HasSubstr("unknown key 'optics.cant_outwards_deg'; did you mean "
                                         "'optics.cant_outward_deg'?")));
    EXPECT_THAT(refusal(folder, good + "[photons]\nillumination = \"roling\"\n"),
                testing::AllOf(HasSubstr("display.toml:10"), HasSubstr("did you mean 'rolling'?")));
    EXPECT_THAT(refusal(folder, good + "[photons]\nillumination = 3\n"), HasSubstr("text"));
    EXPECT_THAT(refusal(folder, good + "cant_outward_deg = [1]\n"), HasSubstr("2 angles"));
    EXPECT_THAT(refusal(folder, good + "cant_outward_deg = [1, 46]\n"),
                HasSubstr("must lie in [-45, 45]"));
    EXPECT_THAT(refusal(folder, good + "cant_outward_deg = [1, nan]\n"), HasSubstr("must lie in"));
    EXPECT_THAT(refusal(folder, good + "[photons]\nswitching_ms = -1\n"),
                HasSubstr("must lie in [0, 1000]"));
    EXPECT_THAT(refusal(folder, good + "[photons]\nscan_out_ms = 11\n"), HasSubstr("period"));
    EXPECT_THAT(refusal(folder, "assumed = [\"optics.ipd\"]\n" + good),
                HasSubstr("'optics.ipd' is no key"));
    EXPECT_THAT(refusal(folder, "assumed = 3\n" + good), HasSubstr("a list of keys"));
    EXPECT_THAT(refusal(folder, "width_px = 64\n"), HasSubstr("height_px: a number is needed"));
}

TEST(Profiles, RefuseATrackerWithoutItsDelay) {
    const tests::ScratchFolder folder;
    const auto loaded = load_tracker(folder.write("tracker.toml", "rate_hz = 100\n"));
    ASSERT_FALSE(loaded.has_value());
    EXPECT_THAT(loaded.error().message, HasSubstr("delay_ms: a number is needed"));
    EXPECT_EQ(loaded.error().kind, ErrorKind::BadInput);
    const auto slow = load_tracker(folder.write("slow.toml", "delay_ms = 1001\n"));
    ASSERT_FALSE(slow.has_value());
    EXPECT_THAT(slow.error().message, HasSubstr("slow.toml:1: delay_ms = 1001: must lie in"));
    // A person's terms are none of a tracker's.
    const auto eye = load_tracker(folder.write("eye.toml", "delay_ms = 1\nblinks_per_min = 3\n"));
    ASSERT_FALSE(eye.has_value());
    EXPECT_THAT(eye.error().message, HasSubstr("eye.toml:2: unknown key 'blinks_per_min'"));
}

TEST(Profiles, NameAllThatThereAre) {
    const auto unknown = load_display("fove1");
    ASSERT_FALSE(unknown.has_value());
    EXPECT_THAT(unknown.error().message,
                testing::AllOf(HasSubstr("did you mean 'fove0'?"), HasSubstr("psvr2"),
                               HasSubstr("quest_pro"), HasSubstr("valve_index"),
                               HasSubstr("varjo_xr4"), HasSubstr("vive_pro_eye")));
}

using latency::Stage;

std::optional<std::int64_t> limit(const latency::LatencyBudget& budget, Stage stage) {
    return budget.stages_ns[static_cast<std::size_t>(stage)];
}

TEST(Budgets, HaveTheFiguresOfTheirSources) {
    constexpr std::int64_t kMs = 1'000'000;
    constexpr std::pair<const char*, std::int64_t> kTotals_ms[] = {
        {"albert2017", 70},          {"guenter2012", 40}, {"loschky_wolverton2007", 60},
        {"mcconkie_loschky2002", 6}, {"stein2021", 81},   {"strict", 22}};
    for (const auto& [name, total_ms] : kTotals_ms) {
        const auto budget = load_budget(name);
        ASSERT_TRUE(budget.has_value()) << name;
        EXPECT_EQ(budget->total_ns, total_ms * kMs) << name;
    }
    const auto guenter = load_budget("guenter2012");
    EXPECT_EQ(limit(*guenter, Stage::Tracker), 10 * kMs);
    EXPECT_EQ(limit(*guenter, Stage::Gpu), 8 * kMs);
    EXPECT_EQ(limit(*guenter, Stage::Switching), 6 * kMs);
    EXPECT_EQ(limit(*guenter, Stage::Queue), std::nullopt);
    EXPECT_EQ(limit(*load_budget("stein2021"), Stage::Tracker), 52 * kMs);
    const auto strict = load_budget("strict");
    std::int64_t sum_ns = 0;
    for (const auto& stage : strict->stages_ns) {
        sum_ns += stage.value_or(0);
    }
    EXPECT_EQ(strict->total_ns, sum_ns) << "as the file says";
}

TEST(Budgets, OfTheUserAreReadAsTheBuiltInOnes) {
    const tests::ScratchFolder folder;
    const std::string file = folder.write("mine.toml", "[stages_ms]\ngpu = 0.5\n");
    const auto mine = load_budget(file);
    ASSERT_TRUE(mine.has_value()) << mine.error().message;
    EXPECT_EQ(mine->name, file);
    EXPECT_EQ(mine->total_ns, std::nullopt) << "unsaid is no limit, never 0";
    EXPECT_EQ(limit(*mine, Stage::Gpu), 500'000);
}

TEST(Budgets, RefuseWhatTheyDoNotKnow) {
    const tests::ScratchFolder folder;
    const auto refused = [&](const std::string& text) {
        const auto budget = load_budget(folder.write("budget.toml", text));
        EXPECT_FALSE(budget.has_value()) << text;
        EXPECT_TRUE(budget || budget.error().kind == ErrorKind::BadInput) << text;
        return budget ? "" : budget.error().message;
    };
    EXPECT_THAT(refused("total_ms = 20\n[stages_ms]\ngpus = 3\n"),
                HasSubstr("budget.toml:3: unknown key 'stages_ms.gpus'; did you mean "
                          "'stages_ms.gpu'?"));
    EXPECT_THAT(refused("total_m = 20\n"), HasSubstr("did you mean 'total_ms'?"));
    for (const char* const number : {"0", "-1", "1000.5", "nan", "inf", "-inf"}) {
        EXPECT_THAT(refused("total_ms = " + std::string(number) + "\n"),
                    HasSubstr("budget.toml:1: total_ms = "))
            << number;
    }
    EXPECT_THAT(refused("total_ms = \"20\"\n"), HasSubstr("a number is needed"));
    EXPECT_THAT(refused("total_ms = 20\n[stages_ms]\nqueue = 2\ngpu = 21\n"),
                HasSubstr("budget.toml:4: stages_ms.gpu: must not be above total_ms"));
    EXPECT_THAT(refused(""), HasSubstr("needs total_ms, or a limit of a stage"));
    EXPECT_THAT(refused("[stages_ms]\n"), HasSubstr("needs total_ms, or a limit of a stage"));
    EXPECT_THAT(refused("stages_ms = 3\n"), HasSubstr("unknown key 'stages_ms'"));
    EXPECT_THAT(refused("total_ms = = 3\n"), HasSubstr("budget.toml:1: "));
    const auto unknown = load_budget("albert2018");
    ASSERT_FALSE(unknown.has_value());
    EXPECT_EQ(unknown.error().kind, ErrorKind::Usage);
    EXPECT_THAT(unknown.error().message,
                HasSubstr("unknown budget 'albert2018'; did you mean 'albert2017'?"));
}

TEST(Budgets, AreInForceWhereTheyAreNamed) {
    ProfileSettings named;
    settings::Settings settings;
    settings.add(rows_of(named));
    auto budget = budget_in_force(named, settings);
    ASSERT_TRUE(budget.has_value());
    EXPECT_EQ(*budget, std::nullopt) << "none unless it is asked for";
    ASSERT_TRUE(settings.set("profile.budget", "strict", "--budget").has_value());
    budget = budget_in_force(named, settings);
    ASSERT_TRUE(budget.has_value() && budget->has_value());
    EXPECT_EQ((*budget)->name, "strict");
    ASSERT_TRUE(settings.set("profile.budget", "stric", "--budget").has_value());
    budget = budget_in_force(named, settings);
    ASSERT_FALSE(budget.has_value());
    EXPECT_THAT(budget.error().message,
                testing::AllOf(HasSubstr("--budget"), HasSubstr("did you mean 'strict'?")));
}

TEST(SimulateTrackerInForce, FillsInWhatNobodyHasSet) {
    ProfileSettings named;
    sim::GazeSimulation simulation;
    settings::Settings settings;
    settings.add(rows_of(named));
    settings.add(rows_of(simulation));
    ASSERT_TRUE(settings.set("profile.tracker", "vive_pro_eye", "--tracker").has_value());
    ASSERT_TRUE(settings.set("sim.noise_deg", "1", "--set").has_value());
    ASSERT_TRUE(simulate_tracker_in_force(named, settings).has_value());
    EXPECT_EQ(simulation.tracker.noise_deg, 1.0);
    EXPECT_EQ(simulation.tracker.delay_ms, 50.0);
    EXPECT_EQ(simulation.tracker.rate_hz, 120.0);
    EXPECT_EQ(simulation.eye.blinks_per_min, 15.0);
    EXPECT_THAT(settings.describe(), HasSubstr("vive_pro_eye"));
}

}  // namespace
}  // namespace gazeloop::profiles
