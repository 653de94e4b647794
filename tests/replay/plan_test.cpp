// `gazeloop plan` as its users run it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

json plan(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "plan");
    arguments.insert(arguments.end(), {"--json", "-"});
    const ProgramResult result = run_gazeloop(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(result.out);
}

json by_name(const json& list, const char* key, const std::string& name) {
    for (const json& entry : list) {
        if (entry.at(key) == name) {
            return entry;
        }
    }
    ADD_FAILURE() << name << " is missing";
    return {};
}

std::string content(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Plan, SaysWhatEyesNeedAndMethodsTake) {
    const json report = plan({"--display", "fove0"});
    EXPECT_EQ(report.at("display_pixels"), 1280 * 1440);
    const auto fewest = [&](const char* model) {
        return by_name(report.at("models"), "model", model).at("fewest_samples").get<double>();
    };
    EXPECT_NEAR(fewest("guenter"), 105.5e3, 0.5e3);
    EXPECT_NEAR(fewest("geisler-perry"), 280.6e3, 1e3);
    EXPECT_NEAR(fewest("stelacsf"), 238.8e3, 1e3);
    EXPECT_GT(fewest("ashraf2025"), 1.7e6);  // this display's pixels are coarser nearly everywhere
    for (const char* const method : {"full", "kfr", "layers", "rings", "sparse"}) {
        const json entry = by_name(report.at("methods"), "method", method);
        const double samples = entry.at("samples").get<double>();
        EXPECT_GT(samples, 1e5) << method;
        EXPECT_NEAR(entry.at("display_over_samples").get<double>(), 1843200.0 / samples, 1e-9);
        const json verdict = by_name(entry.at("sufficiency"), "model", "guenter");
        EXPECT_NEAR(verdict.at("samples_over_fewest").get<double>(), samples / fewest("guenter"),
                    1e-9);
        EXPECT_EQ(verdict.at("sufficient").get<bool>(), std::string(method) != "sparse") << method;
    }
    EXPECT_EQ(by_name(report.at("methods"), "method", "sparse").at("samples"), 184320);
}

TEST(Plan, FollowsItsSettings) {
    const json narrow = plan({"--method", "kfr", "--sigma", "3", "--set", "kfr.disc=false"});
    ASSERT_EQ(narrow.at("methods").size(), 1U);
    const json kfr = narrow.at("methods")[0];
    EXPECT_EQ(kfr.at("figures").at("lp_width"), 427);
    EXPECT_EQ(kfr.at("figures").at("disc_pixels"), 0);
    // Without the disc, the hole at the fovea shows.
    EXPECT_LT(by_name(kfr.at("sufficiency"), "model", "guenter").at("least_ratio").get<double>(),
              0.05);
    const json two = plan({"--method", "layers", "--set", "layers.n=2", "--mar", "0.034"});
    EXPECT_FALSE(two.at("methods")[0].at("figures").contains("layer3_factor"));
    const json fixed = plan({"--method", "layers", "--set", "layers.s2_fixed=true"});
    EXPECT_EQ(fixed.at("methods")[0].at("figures").at("layer2_factor"), 2.0);
    const json half = plan({"--method", "layers", "--set", "layers.outer_weight=0.5"});
    EXPECT_LT(half.at("methods")[0].at("figures").at("weighted_samples").get<double>(),
              half.at("methods")[0].at("samples").get<double>());
    const json rings = plan({"--method", "rings", "--set", "rings.inner_deg=5", "--set",
                             "rings.outer_deg=10", "--model", "stelacsf"});
    EXPECT_EQ(rings.at("methods")[0].at("sufficiency").size(), 1U);
    EXPECT_FALSE(rings.at("methods")[0].at("sufficiency")[0].at("sufficient").get<bool>());
    const json blue = plan({"--method", "sparse", "--set", "sparse.placement=blue_noise", "--set",
                            "sparse.share=0.05"});
    EXPECT_EQ(blue.at("methods")[0].at("samples"), 92160);
}

TEST(Plan, SaysWhereParametersAreUseless) {
    const auto useless = [](const std::vector<std::string>& options) {
        return plan(options).at("methods")[0].at("useless").get<std::string>();
    };
    EXPECT_EQ(useless({"--method", "kfr"}), "");
    EXPECT_NE(
        useless({"--method", "kfr", "--sigma", "32", "--alpha", "16", "--set", "kfr.disc=false"})
            .find("the first column reaches"),
        std::string::npos);
}

// A gaze that the picture's plane has no point for: straight behind.
TEST(Plan, FollowsAGazeBehindTheHead) {
    const json behind = plan({"--method", "acuity", "--gaze", "180,0"});
    const double samples = behind.at("methods")[0].at("samples").get<double>();
    // An eye sees little there. Rows converge behind as they do ahead: some more than it needs.
    EXPECT_LT(samples, 0.01 * behind.at("display_pixels").get<double>());
    EXPECT_TRUE(
        by_name(behind.at("methods")[0].at("sufficiency"), "model", "guenter").at("sufficient"));
    EXPECT_EQ(behind.at("methods")[0].at("figures").at("disc_pixels"), 0);
}

TEST(Plan, WritesJsonToStdoutWithoutAFile) {
    const ProgramResult result =
        run_gazeloop({"plan", "--display", "fove0", "--method", "acuity", "--json"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(json::parse(result.out).at("display"), "fove0");
}

TEST(Plan, KnowsTheGazeAndItsError) {
    const auto fewest = [](const json& report) {
        return by_name(report.at("models"), "model", "guenter").at("fewest_samples").get<double>();
    };
    const json centre = plan({"--method", "full"});
    const json aside = plan({"--method", "full", "--gaze", "45,-40", "--eye", "right"});
    EXPECT_EQ(aside.at("eye"), "right");
    EXPECT_GT(aside.at("fovea_px")[0].get<double>(), 1000.0);
    EXPECT_GT(aside.at("fovea_px")[1].get<double>(), 1200.0);
    EXPECT_LT(fewest(aside), fewest(centre));
    EXPECT_NEAR(fewest(plan({"--method", "full", "--widen", "5"})), 157.2e3, 1e3);
    // Nothing can be seen with the gaze turned away, by a model that ends: no ratio.
    const json away = plan({"--method", "full", "--gaze", "180,0", "--model", "stelacsf"});
    EXPECT_TRUE(away.at("methods")[0].at("sufficiency")[0].at("least_ratio").is_null());
}

TEST(Plan, WidensByWhatTheTrackersFiguresSay) {
    const auto widened = [](std::vector<std::string> more) {
        more.insert(more.begin(), {"--method", "full", "--widen", "tracker", "--display", "fove0"});
        return plan(more).at("widening_deg").get<double>();
    };
    // Bias .41 for half and 2.6 times that for 95 %, noise .135, 10 deg/s over 50 + 1 ms, half of
    // 1/120 s and 1/70 s.
    const double latency_s = 0.051 + 0.5 / 120.0 + 1.0 / 70.0;
    const std::vector<std::string> vive{"--tracker", "vive_pro_eye"};
    EXPECT_NEAR(widened(vive), 2.6 * 0.41 + 1.96 * 0.135 + 10.0 * latency_s, 1e-6);
    EXPECT_NEAR(
        widened({"--tracker", "vive_pro_eye", "--gaze", "-12,-16"}),
        2.6 * 0.41 * (1.0 + 0.05 * 19.91) + 1.96 * 0.135 * (1.0 + 0.03 * 19.91) + 10.0 * latency_s,
        1e-3);
    EXPECT_NEAR(widened({"--tracker", "vive_pro_eye", "--set", "sim.pursuit_deg_per_s=0", "--set",
                         "sim.bias_deg=0"}),
                1.96 * 0.135, 1e-9);
    // Of a tracker that states nothing nothing follows.
    const ScratchFolder folder;
    const std::string bare = folder.write("bare.toml", "delay_ms = 5\n");
    const ProgramResult refused = run_gazeloop({"plan", "--widen", "tracker", "--tracker", bare});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("states no sim.bias_deg: state it with"));
}

TEST(Plan, DrawsAllMethods) {
    const ScratchFolder folder;
    const std::string png = folder.file("plan.png");
    const std::string svg = folder.file("plan.svg");
    ASSERT_EQ(run_gazeloop({"plan", "--method", "kfr", "--png", png, "--quiet"}).exit_code, 0);
    EXPECT_THAT(content(png), StartsWith("\x89PNG"));
    ASSERT_EQ(run_gazeloop({"plan", "--png", svg, "--quiet"}).exit_code, 0);
    EXPECT_THAT(content(svg), HasSubstr("<svg"));
}

TEST(Plan, PredictsTheFiguresOfThePaper) {
    const ScratchFolder folder;
    const std::string figures = folder.file("figures");
    const ProgramResult result = run_gazeloop({"plan", "--figures", figures});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("103.0x with A"));
    for (const char* const name : {"speedup_a", "speedup_b", "cost_full", "cost_layers"}) {
        EXPECT_TRUE(std::filesystem::exists(figures + "/" + name + ".png"));
        EXPECT_TRUE(std::filesystem::exists(figures + "/" + name + ".svg"));
    }
    const std::string csv = content(figures + "/layers.csv");
    EXPECT_THAT(csv, StartsWith("fov_deg,slope,layers,second_factor,display_pixels,layer_pixels,"
                                "speedup\n10,"));
    EXPECT_THAT(csv, HasSubstr("\n70,0.0275,4,0,"));
}

struct Refused {
    const char* name;
    std::vector<std::string> arguments;
    int exit_code;
    const char* message;
};

void PrintTo(const Refused& at, std::ostream* out) { *out << at.name; }

class PlanRefuses : public testing::TestWithParam<Refused> {};

TEST_P(PlanRefuses, WithMessageAndCode) {
    const ProgramResult result = run_gazeloop(GetParam().arguments);
    EXPECT_EQ(result.exit_code, GetParam().exit_code) << result.err;
    EXPECT_THAT(result.err, HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    BadInput, PlanRefuses,
    testing::Values(
        Refused{"display", {"plan", "--display", "fove1"}, 2, "did you mean 'fove0'"},
        Refused{"method", {"plan", "--method", "ring"}, 2, "did you mean 'rings'"},
        Refused{"model", {"plan", "--model", "gunter"}, 2, "did you mean 'guenter'"},
        Refused{"gaze", {"plan", "--gaze", "nan,0"}, 2, "gaze"},
        Refused{"mar_zero", {"plan", "--mar", "0"}, 2, "acuity.mar = 0: must lie in [1e-06, 1]"},
        Refused{"mar_nan", {"plan", "--mar", "nan"}, 2, "acuity.mar = nan"},
        Refused{"widen", {"plan", "--widen", "181"}, 2, "[0, 180]"},
        Refused{"widen_by_what", {"plan", "--widen", "trackr"}, 2, "'trackr' must be degrees"},
        Refused{"eye", {"plan", "--eye", "third"}, 2, "--eye"},
        Refused{"rings",
                {"plan", "--method", "rings", "--set", "rings.inner_deg=9", "--set",
                 "rings.outer_deg=5"},
                2,
                "rings.outer_deg = 5"},
        Refused{
            "layers",
            {"plan", "--method", "layers", "--set", "layers.n=2", "--set", "layers.s2_fixed=true"},
            2,
            "set layers.n to 3 or 4, or layers.s2_fixed to false"},
        Refused{"chart_ending", {"plan", "--png", "/tmp/plan.bmp"}, 2, ".png or .svg"},
        Refused{"chart_folder", {"plan", "--png", "/nowhere/plan.png"}, 3, "/nowhere/plan.png"},
        Refused{"json_folder", {"plan", "--json", "/nowhere/plan.json"}, 3, "/nowhere/plan.json"},
        Refused{"figures_folder", {"plan", "--figures", "/dev/null/x"}, 3, "/dev/null/x"}),
    [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace gazeloop::tests
