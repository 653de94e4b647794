// `gazeloop trade` as its users run it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "tests/support/gltf_file.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

using nlohmann::json;
using testing::HasSubstr;

ProgramResult trade(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"trade", "--set", "render.scale=0.08"});
    return run_gazeloop(arguments);
}

TEST(Trade, SetsCostAgainstQuality) {
    const ScratchFolder folder;
    const std::string csv = folder.file("trade.csv");
    const std::string json_file = folder.file("trade.json");
    const ProgramResult result =
        trade({"--methods", "full,kfr", "--sigma", "1.2,3.2", "--alpha", "4", "--frames", "2",
               "--rounds", "2", "--spp", "4", "--csv", csv, "--json", json_file});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("kfr.sigma=3.2 kfr.alpha=4"));
    EXPECT_THAT(result.out, HasSubstr("stelaCSF"));
    const json report = json::parse(std::ifstream(json_file));
    EXPECT_EQ(report.at("frames"), 2);
    EXPECT_EQ(report.at("reference_samples"), 16);
    const json& points = report.at("points");
    ASSERT_EQ(points.size(), 3U);
    EXPECT_EQ(points[0].at("method"), "full");
    EXPECT_NEAR(points[0].at("fewer_cells").get<double>(), 1.0, 1e-9);
    EXPECT_NEAR(points[0].at("speedup").get<double>(), 1.0, 1e-9);
    const auto contrast = [&](std::size_t point) {
        return points[point].at("figures").at("contrast").at("mean").get<double>();
    };
    // Full resolution with fewer samples is no reference: it aliases more.
    EXPECT_GT(contrast(0), 0.0);
    EXPECT_GT(contrast(1), contrast(0));
    EXPECT_GT(contrast(2), contrast(1));
    EXPECT_GT(points[2].at("fewer_cells").get<double>(), points[1].at("fewer_cells").get<double>());
    for (const json& point : points) {
        EXPECT_GT(point.at("time_ms").at("median").get<double>(), 0.0);
        EXPECT_LE(point.at("time_ms").at("least"), point.at("time_ms").at("greatest"));
        EXPECT_GT(point.at("pass_ms").at(point.at("method") == "full" ? "full" : "resolve"), 0.0);
        // One bound for all: what Guenter's line asks for at this gaze.
        EXPECT_NEAR(
            point.at("cells_per_frame").get<double>() / point.at("cells_over_fewest").get<double>(),
            points[0].at("cells_per_frame").get<double>() /
                points[0].at("cells_over_fewest").get<double>(),
            1.0);
        EXPECT_EQ(point.at("rays_per_frame").get<double>(),
                  4.0 * point.at("cells_per_frame").get<double>());
        EXPECT_TRUE(point.at("on_cells_front").get<bool>());
        EXPECT_EQ(point.at("figures").size(), 10U);
    }
    std::ifstream lines(csv);
    EXPECT_EQ(std::count(std::istreambuf_iterator<char>(lines), {}, '\n'), 4);
}

std::string text_of(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// A line of the journal for each comparison and each timed frame, after the first one.
std::size_t lines_of(const std::string& text) {
    return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

TEST(Trade, MeasuresNothingTwiceAndLosesNothingThatWasMeasured) {
    const ScratchFolder folder;
    const std::string journal = folder.file("trade.journal");
    const std::string json_file = folder.file("trade.json");
    const std::vector<std::string> asked{"--methods", "kfr",      "--sigma",  "1.8",    "--alpha",
                                         "4",         "--gaze",   "0,0",      "--gaze", "9,4",
                                         "--frames",  "2",        "--rounds", "2",      "--metric",
                                         "psnr",      "--resume", journal,    "--json", json_file};
    const ProgramResult whole = trade(asked);
    ASSERT_EQ(whole.exit_code, 0) << whole.err;
    const std::string all = text_of(journal);
    ASSERT_EQ(lines_of(all), 1U + 2 * (2 + 4));
    const json first = json::parse(std::ifstream(json_file));
    ASSERT_EQ(first.at("cases").size(), 2U);
    ASSERT_EQ(first.at("points").size(), 4U);
    EXPECT_EQ(first.at("means").size(), 2U);

    // All there: nothing is measured, and the report is the same to the last bit.
    ASSERT_EQ(trade(asked).exit_code, 0);
    EXPECT_EQ(text_of(journal), all);
    EXPECT_EQ(json::parse(std::ifstream(json_file)), first);

    // Killed in the middle of a line: what was whole stays as it was, the rest is measured.
    std::size_t cut = 0;
    for (int line = 0; line < 5; ++line) {
        cut = all.find('\n', cut) + 1;
    }
    ASSERT_EQ(folder.write("trade.journal", all.substr(0, cut + 9)), journal);
    const ProgramResult resumed = trade(asked);
    ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_THAT(resumed.err, HasSubstr("cut short"));
    const std::string again = text_of(journal);
    EXPECT_EQ(again.substr(0, cut), all.substr(0, cut));
    EXPECT_EQ(lines_of(again), lines_of(all));
    const json second = json::parse(std::ifstream(json_file));
    for (std::size_t point = 0; point < 4; ++point) {
        EXPECT_EQ(second.at("points")[point].at("figures"),
                  first.at("points")[point].at("figures"));
    }

    // Another sweep does not go on there.
    std::vector<std::string> other = asked;
    other[5] = "2";
    const ProgramResult refused = trade(other);
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_THAT(refused.err, HasSubstr("kfr.alpha=2"));
    EXPECT_EQ(text_of(journal), again);
}

TEST(Trade, DoesNotGoOnWithAnotherSceneOfTheSameName) {
    const ScratchFolder folder;
    const auto write_scene = [&](double height) {
        GltfFile file = one_triangle();
        file.document["nodes"][0]["scale"] = {1.0, height, 1.0};
        const std::vector<std::byte> bytes = file.glb();
        return folder.write("a.glb", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    };
    const std::string scene = write_scene(1.0);
    const std::string journal = folder.file("trade.journal");
    const std::vector<std::string> asked{"--scene",  scene,  "--methods", "kfr",  "--sigma",  "1.8",
                                         "--alpha",  "4",    "--frames",  "1",    "--rounds", "2",
                                         "--metric", "psnr", "--resume",  journal};
    ASSERT_EQ(trade(asked).exit_code, 0);
    const std::string all = text_of(journal);
    ASSERT_EQ(trade(asked).exit_code, 0);
    ASSERT_EQ(write_scene(0.8), scene);
    // Complete, with a round to be timed, with a point to be judged.
    std::string left = all;
    for (int missing = 0; missing < 4; ++missing) {
        ASSERT_EQ(folder.write("trade.journal", left), journal);
        const ProgramResult result = trade(asked);
        EXPECT_EQ(result.exit_code, 3) << missing << result.err;
        EXPECT_THAT(result.err, HasSubstr("a.glb' is not what it was when this sweep began"));
        EXPECT_EQ(text_of(journal), left);
        left = left.substr(0, left.rfind('\n', left.size() - 2) + 1);
    }
    ASSERT_EQ(write_scene(1.0), scene);
    EXPECT_EQ(trade(asked).exit_code, 0);
}

TEST(Trade, SplitsASweepAndMergesIt) {
    const ScratchFolder folder;
    const auto shard = [&](const std::string& which, const std::string& file) {
        return trade({"--methods", "kfr", "--sigma", "1.8,3.2", "--alpha", "4", "--frames", "1",
                      "--rounds", "1", "--metric", "psnr", "--shard", which, "--resume",
                      folder.file(file), "--quiet"});
    };
    EXPECT_EQ(shard("1/2", "one").exit_code, 0);
    EXPECT_EQ(shard("2/2", "two").exit_code, 0);
    const ProgramResult half = run_gazeloop({"trade", "--merge", folder.file("one")});
    EXPECT_EQ(half.exit_code, 1);
    EXPECT_THAT(half.err, HasSubstr("not measured"));
    const ProgramResult result =
        run_gazeloop({"trade", "--merge", folder.file("one"), "--merge", folder.file("two"),
                      "--json", "-", "--html", folder.file("page.html")});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json points = json::parse(result.out).at("points");
    ASSERT_EQ(points.size(), 3U);
    for (const json& point : points) {
        EXPECT_GT(point.at("speedup").get<double>(), 0.0);
    }
    EXPECT_THAT(text_of(folder.file("page.html")), HasSubstr("Samples against quality"));
    EXPECT_EQ(run_gazeloop({"trade", "--merge", folder.file("one"), "--merge", folder.file("one")})
                  .exit_code,
              3);
}

TEST(Trade, RecommendsAndFits) {
    const ScratchFolder folder;
    const std::string page = folder.file("trade.html");
    const ProgramResult result =
        trade({"--methods", "kfr", "--sigma", "1.5,2,3,4", "--alpha", "4", "--frames", "1",
               "--rounds", "1", "--limit", "contrast=1000", "--fit", "--html", page});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("Recommended for contrast at most 1000: kfr"));
    EXPECT_THAT(result.out, HasSubstr("kfr.sigma^-"));
    const std::string text = text_of(page);
    EXPECT_THAT(text, HasSubstr("data:image/png;base64,"));
    EXPECT_LT(text.size(), 3'000'000U);

    ASSERT_EQ(run_program({"chromium", "--version"}).exit_code, 0)
        << "no chromium: ./dev test installs it";
    const ProgramResult seen =
        run_program({"chromium", "--headless=new", "--no-sandbox", "--disable-gpu",
                     "--user-data-dir=" + folder.file("profile"), "--enable-logging=stderr",
                     "--virtual-time-budget=5000", "--dump-dom", "file://" + page});
    EXPECT_THAT(seen.err, testing::Not(HasSubstr("CONSOLE")));
    EXPECT_THAT(seen.out, HasSubstr("data-state=\"drawn\""));
    EXPECT_THAT(seen.out, HasSubstr("data-plots=\"2\""));
}

// What is set, or varied, is in the pictures; the reference is without.
TEST(Trade, RendersByTheFiltersThatAreSet) {
    const auto contrast_of = [](const std::vector<std::string>& filters) {
        std::vector<std::string> arguments{"--methods", "kfr", "--sigma",  "2.4", "--alpha", "4",
                                           "--frames",  "1",   "--rounds", "1",   "--json",  "-"};
        arguments.insert(arguments.end(), filters.begin(), filters.end());
        const ProgramResult result = trade(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        std::vector<double> contrast;
        for (const json report = json::parse(result.out); const json& point : report.at("points")) {
            contrast.push_back(point.at("figures").at("contrast").at("mean").get<double>());
        }
        return contrast;
    };
    const std::vector<double> plain = contrast_of({});
    const std::vector<double> set = contrast_of({"--set", "render.footprint_taps=16"});
    const std::vector<double> varied = contrast_of({"--vary", "render.footprint_taps=1,16"});
    ASSERT_EQ(plain.size(), 2U);
    ASSERT_EQ(set.size(), 2U);
    ASSERT_EQ(varied.size(), 3U);
    EXPECT_NE(set[1], plain[1]);
    EXPECT_EQ(varied[1], plain[1]);
    EXPECT_EQ(varied[2], set[1]);
}

TEST(Trade, TellsWhatEachPartIsWorth) {
    const ScratchFolder folder;
    const std::string json_file = folder.file("worth.json");
    const ProgramResult result =
        trade({"--worth", "kfr", "--scene", "gallery", "--frames", "1", "--rounds", "1",
               "--reference-spp", "4", "--metric", "contrast", "--json", json_file});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("lies between that and the limit of resolution of 2025"));
    // What cannot be is said, and fails nothing.
    EXPECT_THAT(result.err, HasSubstr("kfr.kernel=table is left out"));
    const json report = json::parse(std::ifstream(json_file));
    const auto part = [&](const char* change) {
        for (const json& one : report.at("worth").at("parts")) {
            if (one.at("change") == change) {
                return one;
            }
        }
        ADD_FAILURE() << change;
        return json();
    };
    // What the scene does not need changes no bit of it.
    EXPECT_TRUE(part("render.require=all").at("same_pictures").get<bool>());
    EXPECT_FALSE(part("render.require=all").at("needless").get<bool>());
    EXPECT_FALSE(part("kfr.disc=false").at("same_pictures").get<bool>());
    EXPECT_LT(part("kfr.kernel=polynomial").at("cells").get<double>(), 0.9);
    const json& shares = report.at("cases")[0].at("contrast_shares");
    EXPECT_NEAR(shares.at("kept").get<double>() + shares.at("between").get<double>() +
                    shares.at("beyond").get<double>(),
                1.0, 1e-9);
    EXPECT_EQ(trade({"--worth", "kfrr"}).exit_code, 2);
    EXPECT_EQ(trade({"--worth", "kfr", "--sigma", "2"}).exit_code, 2);
}

TEST(Trade, FitsABuffersShapeThatRunsTake) {
    const ScratchFolder folder;
    const std::string toml = folder.file("fitted.toml");
    const std::string json_file = folder.file("trade.json");
    const ProgramResult result = trade(
        {"--methods", "kfr", "--fitted", toml, "--fewer", "4", "--frames", "1", "--rounds", "1",
         "--spp", "2", "--reference-spp", "4", "--metric", "contrast", "--json", json_file});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json points = json::parse(std::ifstream(json_file)).at("points");
    ASSERT_EQ(points.size(), 3U);  // full, as it was, fitted
    const auto contrast = [&](std::size_t point) {
        return points[point].at("figures").at("contrast").at("mean").get<double>();
    };
    EXPECT_LT(contrast(2), contrast(1));
    EXPECT_NEAR(points[2].at("cells_per_frame").get<double>() /
                    points[1].at("cells_per_frame").get<double>(),
                1.0, 0.05);
    const ProgramResult run = run_gazeloop(
        {"run", "--config", toml, "--gaze", "fixed:0,0", "--target", "headless", "--clock",
         "virtual", "--frames", "2", "--set", "render.scale=0.08", "--print-config"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("kfr.kernel                   = 'table'"));
    EXPECT_THAT(trade({"--fitted", toml}).err, HasSubstr("no log-polar buffer"));
    EXPECT_EQ(trade({"--fewer", "4"}).exit_code, 2);
    const ProgramResult none =
        trade({"--methods", "kfr", "--fitted", toml, "--fewer", "900", "--set", "kfr.sigma=3"});
    EXPECT_THAT(none.err, HasSubstr("has no effect with --fitted"));
    EXPECT_EQ(none.exit_code, 2) << none.err;
    EXPECT_THAT(none.err, HasSubstr("no kfr.sigma gives 900 times fewer"));
    EXPECT_THAT(none.err, HasSubstr("name another --fewer"));
}

TEST(Trade, GivesTheSameQualityTwice) {
    const std::vector<std::string> asked{"--methods", "acuity", "--mar",  "0.022", "--frames", "2",
                                         "--rounds",  "1",      "--gaze", "5,3",   "--json",   "-"};
    const json once = json::parse(trade(asked).out);
    const json again = json::parse(trade(asked).out);
    for (std::size_t point = 0; point < 2; ++point) {
        EXPECT_EQ(once.at("points")[point].at("figures"), again.at("points")[point].at("figures"));
    }
}

TEST(Trade, GoesOnWherePointsFail) {
    const ProgramResult result =
        trade({"--methods", "layers", "--vary", "layers.n=4,2", "--set", "layers.s2_fixed=true",
               "--frames", "1", "--rounds", "1", "--metric", "psnr", "--json", "-"});
    EXPECT_EQ(result.exit_code, 1) << result.err;
    EXPECT_THAT(result.err, HasSubstr("layers.s2_fixed"));
    const json points = json::parse(result.out).at("points");
    ASSERT_EQ(points.size(), 3U);
    EXPECT_TRUE(points[1].contains("figures"));
    EXPECT_THAT(points[2].at("error").get<std::string>(), HasSubstr("layers.n"));
}

TEST(Trade, ReportsTheScenesThatCanBeShown) {
    const ScratchFolder folder;
    const std::string none = folder.file("none.lightfield");
    const ProgramResult result =
        trade({"--scenes", none + ",raymarch", "--methods", "kfr", "--sigma", "2", "--frames", "1",
               "--rounds", "1", "--metric", "psnr", "--json", "-"});
    EXPECT_EQ(result.exit_code, 1) << result.err;
    EXPECT_THAT(result.err, HasSubstr("none.lightfield"));
    const json points = json::parse(result.out).at("points");
    ASSERT_EQ(points.size(), 4U);
    EXPECT_TRUE(points[0].contains("error") && points[1].contains("error"));
    EXPECT_TRUE(points[3].contains("figures"));
    // Alone, it is an input that cannot be read.
    EXPECT_EQ(trade({"--scene", none, "--frames", "1"}).exit_code, 3);
}

TEST(Trade, RefusesWhatItCannotSweep) {
    struct Case {
        std::vector<std::string> arguments;
        int exit_code;
        const char* said;
    };
    for (const Case& bad : std::vector<Case>{
             {{"--methods", "kfrr"}, 2, "kfr"},
             {{"--methods", ""}, 2, "a name is needed"},
             {{"--vary", "kfr.sigma"}, 2, "KEY="},
             {{"--vary", "render.spp=1,4"}, 2, "render.spp"},
             {{"--methods", "kfr", "--vary", "kfr.sgima=1.8,2"}, 2, "did you mean 'kfr.sigma'"},
             {{"--methods", "acuity", "--sigma", "1.8"}, 2, "kfr.sigma"},
             {{"--frames", "0"}, 2, "--frames"},
             {{"--frames", "100000", "--set", "render.scale=1"}, 2, "--frames"},
             {{"--scene", "nothing"}, 2, "nothing"},
             {{"--gaze", "up"}, 2, "up"},
             {{"--csv", "/nowhere/at/all.csv"}, 3, "/nowhere"},
             {{"--html", "/nowhere/at/all.html"}, 3, "/nowhere"},
             {{"--resume", "/nowhere/at/all"}, 3, "/nowhere"},
             {{"--merge", "/nowhere/at/all"}, 3, "/nowhere"},
             {{"--shard", "3/2"}, 2, "3/2"},
             {{"--scenes", "raymarch,"}, 2, "empty"},
             {{"--scenes", "raymarch,nothing", "--frames", "1"}, 2, "nothing"},
             {{"--limit", "contrast"}, 2, "FIGURE=NUMBER"},
             {{"--limit", "foo=1"}, 2, "unknown figure 'foo'"},
             {{"--limit", "flip=1", "--metric", "ssim"}, 2, "unknown figure 'flip'"},
             {{"--methods", "kfr,kfr"}, 2, "has kfr twice"},
             {{"--scenes", "raymarch,raymarch"}, 2, "has raymarch twice"},
             {{"--gaze", "0,0", "--gaze", "0,0"}, 2, "--gaze 0,0 is there twice"},
             {{"--scene", "raymarch", "--scenes", "gallery"}, 2, "--scenes excludes --scene"},
             {{"--merge", "j", "--methods", "kfr"}, 2, "--methods excludes --merge"},
             {{"--merge", "/dev/zero"}, 3, "it is no regular file"},
             {{"--resume", "/dev/full"}, 3, "it is no regular file"},
             {{"--worth", "kfr", "--published-grid"}, 2, "excludes"},
             {{"--worth", "kfr", "--shard", "1/2"}, 2, "excludes"},
             {{"--methods", "kfr", "--fitted", "f", "--resume", "j"}, 2, "excludes"},
             {{"--methods", "interleaved", "--fitted", "/tmp/f", "--frames", "1"}, 2, "--frames 4"},
             {{"--merge", "j", "--metric", "flip"}, 2, "--metric excludes --merge"},
             {{"--merge", "j", "--spp", "2"}, 2, "--merge excludes --spp"},
             {{"--budget-ms", "0"}, 2, "--budget-ms"},
         }) {
        const ProgramResult result = trade(bad.arguments);
        EXPECT_EQ(result.exit_code, bad.exit_code) << bad.said << '\n' << result.err;
        EXPECT_THAT(result.err, HasSubstr(bad.said));
    }
}

}  // namespace
}  // namespace gazeloop::tests
