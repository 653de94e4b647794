// `gazeloop compare` as its users run it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "runtime/render/png_file.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

/// A picture of codes, made of its position and a shift.
void write_picture(const std::string& file, int shift, std::uint32_t width = 64,
                   std::uint32_t height = 48) {
    render::Picture picture{width, height, {}};
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const auto code = static_cast<std::uint8_t>(60 + (x / 5 + y / 7) % 2 * 80 +
                                                        static_cast<unsigned>(shift));
            picture.pixels.push_back({code, code, code});
        }
    }
    ASSERT_TRUE(render::write_png(picture, file));
}

ProgramResult compare(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "compare");
    return run_gazeloop(arguments);
}

json compared(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--json", "-"});
    const ProgramResult result = compare(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(result.out);
}

/// A folder of frames whose nth one is shifted by shifts[n].
std::string frames_in(const ScratchFolder& folder, const std::string& name,
                      const std::vector<int>& shifts) {
    std::filesystem::create_directories(folder.file(name));
    for (std::size_t at = 0; at < shifts.size(); ++at) {
        write_picture(folder.file(name + "/" + std::to_string(100 + at) + ".png"), shifts[at]);
    }
    return folder.file(name);
}

TEST(Compare, CallsIdenticalPicturesIdentical) {
    const ScratchFolder folder;
    write_picture(folder.file("a.png"), 0);
    const ProgramResult result = compare({folder.file("a.png"), folder.file("a.png")});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.out, HasSubstr("identical"));
    EXPECT_THAT(result.out, HasSubstr("stelaCSF"));
    const json report = compared({folder.file("a.png"), folder.file("a.png")});
    EXPECT_EQ(report.at("figures").at("contrast").at("mean"), 0.0);
    EXPECT_EQ(report.at("figures").at("flip").at("mean"), 0.0);
    EXPECT_EQ(report.at("figures").at("ssim").at("mean"), 1.0);
    EXPECT_TRUE(report.at("figures").at("psnr_db").at("mean").is_null());
    EXPECT_TRUE(report.at("frame_seconds").is_null());
}

TEST(Compare, SaysByHowMuchPicturesDiffer) {
    const ScratchFolder folder;
    write_picture(folder.file("a.png"), 0);
    write_picture(folder.file("b.png"), 10);
    const json report = compared({folder.file("a.png"), folder.file("b.png"), "--display",
                                  "vive_pro_eye", "--eye", "right"});
    EXPECT_EQ(report.at("display"), "vive_pro_eye");
    EXPECT_EQ(report.at("eye"), "right");
    EXPECT_EQ(report.at("width_px"), 64);
    const json& figures = report.at("figures");
    EXPECT_NEAR(figures.at("psnr_db").at("mean").get<double>(), 20.0 * std::log10(25.5), 1e-3);
    EXPECT_NEAR(figures.at("psnr_weighted_db").at("mean").get<double>(), 20.0 * std::log10(25.5),
                1e-3);
    EXPECT_GT(figures.at("contrast").at("mean").get<double>(), 0.05);
    EXPECT_GT(figures.at("flip").at("mean").get<double>(), 0.02);
    EXPECT_LT(figures.at("ssim").at("mean").get<double>(), 1.0);
    EXPECT_EQ(figures.at("ssim").at("better"), "higher");
    ASSERT_EQ(report.at("frames").size(), 1U);
    EXPECT_EQ(report.at("frames")[0].at("contrast"), figures.at("contrast").at("mean"));
    // The same bits with one thread.
    EXPECT_EQ(compared({folder.file("a.png"), folder.file("b.png"), "--display", "vive_pro_eye",
                        "--eye", "right", "--threads", "1"}),
              report);
}

TEST(Compare, SaysWherePicturesHaveAnotherShapeThanTheDisplay) {
    const ScratchFolder folder;
    write_picture(folder.file("wide.png"), 0, 64, 48);
    write_picture(folder.file("eye.png"), 0, 64, 72);
    EXPECT_THAT(compare({folder.file("wide.png"), folder.file("wide.png")}).err,
                HasSubstr("not square"));
    EXPECT_EQ(compare({folder.file("eye.png"), folder.file("eye.png")}).err, "");
}

TEST(Compare, FollowsGazeLightAndChoice) {
    const ScratchFolder folder;
    write_picture(folder.file("a.png"), 0);
    write_picture(folder.file("b.png"), 10);
    const auto contrast = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {folder.file("a.png"), folder.file("b.png")});
        return compared(arguments).at("figures").at("contrast").at("mean").get<double>();
    };
    const double ahead = contrast({});
    EXPECT_LT(contrast({"--gaze", "80,0"}), 0.9 * ahead);
    EXPECT_LT(contrast({"--peak", "1"}), ahead) << "dim pictures show less";
    EXPECT_LT(contrast({"--black", "90"}), ahead) << "so do washed out ones";
    const json chosen = compared(
        {folder.file("a.png"), folder.file("b.png"), "--metric", "psnr", "--metric", "flip"});
    EXPECT_EQ(chosen.at("figures").size(), 3U);
    EXPECT_FALSE(chosen.at("figures").contains("contrast"));
}

TEST(Compare, ComparesSequences) {
    const ScratchFolder folder;
    const std::string steady = frames_in(folder, "steady", std::vector<int>(12, 0));
    std::vector<int> shifts(12, 0);
    shifts[7] = 30;
    const std::string flashes = frames_in(folder, "flashes", shifts);
    const ProgramResult table = compare({steady, flashes});
    EXPECT_EQ(table.exit_code, 0);
    EXPECT_THAT(table.out, HasSubstr("12 frames"));
    const json report =
        compared({steady, flashes, "--fps", "50", "--heat-map", folder.file("heat")});
    EXPECT_EQ(report.at("frame_count"), 12);
    EXPECT_EQ(report.at("frame_seconds"), 0.02);
    ASSERT_EQ(report.at("frames").size(), 12U);
    EXPECT_EQ(report.at("figures").at("psnr_db").at("worst_frame"), 8);
    EXPECT_EQ(report.at("figures").at("contrast_flicker").at("worst_frame"), 8);
    EXPECT_EQ(report.at("frames")[6].at("contrast"), 0.0);
    EXPECT_GT(report.at("frames")[8].at("contrast").get<double>(), 0.0) << "it lasts in the eye";
    for (int frame = 100; frame < 112; ++frame) {
        const auto map = render::read_png(folder.file("heat/" + std::to_string(frame) + ".png"));
        ASSERT_TRUE(map) << frame;
        EXPECT_EQ(map->width, 64U);
        EXPECT_EQ(map->pixels[0] == glm::vec3(0.0F), frame < 107) << frame;
    }
}

TEST(Compare, FollowsATracesGaze) {
    const ScratchFolder folder;
    const std::string a = frames_in(folder, "a", std::vector<int>(6, 0));
    const std::string b = frames_in(folder, "b", std::vector<int>(6, 10));
    // Ahead for 20 ms, then far to the right; the last two of six frames come after its end.
    std::string rows = "t_device_ns,left_valid,left_x,left_y,left_z\n";
    for (int at = 0; at <= 8; ++at) {
        rows += std::to_string(1'000'000'000 + at * 5'000'000) +
                (at < 4 ? ",1,0,0,-1\n" : ",1,0.98,0,-0.2\n");
    }
    const std::string trace = folder.write("gaze.csv", rows);
    const json report = compared({a, b, "--gaze", "trace:" + trace, "--fps", "100"});
    EXPECT_EQ(report.at("gaze_held_frames"), 1);
    const auto contrast = [&](std::size_t frame) {
        return report.at("frames")[frame].at("contrast").get<double>();
    };
    EXPECT_LT(contrast(2), 0.9 * contrast(1));
    EXPECT_NEAR(contrast(5), contrast(2), 1e-3 * contrast(2));
    EXPECT_THAT(compare({a, b, "--gaze", "trace:" + trace, "--fps", "100"}).out,
                HasSubstr("ended before the last 1 frames"));
}

TEST(Compare, NamesMetricsThatJudgeSmallPictures) {
    const ScratchFolder folder;
    write_picture(folder.file("a.png"), 0, 1, 1);
    write_picture(folder.file("b.png"), 9, 1, 1);
    const ProgramResult refused = compare({folder.file("a.png"), folder.file("b.png")});
    EXPECT_EQ(refused.exit_code, 2) << refused.err;
    EXPECT_THAT(refused.err, HasSubstr("--metric contrast and --metric psnr"));
    const json judged = compared(
        {folder.file("a.png"), folder.file("b.png"), "--metric", "contrast", "--metric", "psnr"});
    ASSERT_EQ(judged["frames"].size(), 1U) << judged;
    EXPECT_THAT(judged.dump(), HasSubstr("psnr_db"));
    EXPECT_THAT(judged.dump(), HasSubstr("contrast_flicker"));
    EXPECT_THAT(judged.dump(), Not(HasSubstr("ssim")));
}

TEST(Compare, DrawsAHeatMap) {
    const ScratchFolder folder;
    write_picture(folder.file("a.png"), 0);
    write_picture(folder.file("b.png"), 40);
    for (const std::string metric : {"contrast", "flip"}) {
        const std::string file = folder.file(metric + "-heat.png");
        EXPECT_EQ(compare({folder.file("a.png"), folder.file("b.png"), "--metric", metric,
                           "--heat-map", file})
                      .exit_code,
                  0);
        const auto map = render::read_png(file);
        ASSERT_TRUE(map);
        EXPECT_GT(map->pixels[1000].x, 0.0F);
    }
}

TEST(Compare, JudgesLimits) {
    const ScratchFolder folder;
    write_picture(folder.file("a.png"), 0);
    write_picture(folder.file("b.png"), 10);
    const auto judged = [&](std::vector<std::string> limits) {
        limits.insert(limits.begin(), {folder.file("a.png"), folder.file("b.png")});
        return compare(limits);
    };
    EXPECT_EQ(judged({"--limit", "psnr_db=28", "--limit", "flip=0.5"}).exit_code, 0);
    const ProgramResult broken = judged({"--limit", "psnr_db=29", "--limit", "flip=0.001"});
    EXPECT_EQ(broken.exit_code, 1);
    EXPECT_THAT(broken.err, HasSubstr("psnr_db is 28.1"));
    EXPECT_THAT(broken.err, HasSubstr("flip is"));
    EXPECT_EQ(judged({"--limit", "contrst=1"}).exit_code, 2);
    EXPECT_THAT(judged({"--limit", "contrst=1"}).err, HasSubstr("contrast"));
    EXPECT_EQ(judged({"--limit", "flip"}).exit_code, 2);
    EXPECT_EQ(judged({"--limit", "flip=nan"}).exit_code, 2);
    EXPECT_EQ(judged({"--metric", "psnr", "--limit", "flip=1"}).exit_code, 2);
}

TEST(Compare, RefusesWhatCannotBeCompared) {
    const ScratchFolder folder;
    write_picture(folder.file("a.png"), 0);
    write_picture(folder.file("wide.png"), 0, 65);
    write_picture(folder.file("tiny.png"), 0, 8, 8);
    const std::string frames = frames_in(folder, "frames", {0, 0, 0});
    const std::string fewer = frames_in(folder, "fewer", {0, 0});
    const std::string gap = frames_in(folder, "gap", {0, 0, 0});
    std::filesystem::remove(gap + "/101.png");
    const std::string text = folder.write("text.png", "no picture");
    const std::string a = folder.file("a.png");
    struct Case {
        std::vector<std::string> arguments;
        int exit_code;
        const char* said;
    };
    const std::vector<Case> cases{
        {{a, folder.file("wide.png")}, 3, "64x48"},
        {{a, folder.file("none.png")}, 3, "none.png"},
        {{a, text}, 3, "text.png"},
        {{folder.file("tiny.png"), folder.file("tiny.png")}, 3, "SSIM"},
        {{frames, fewer}, 3, "3 frames"},
        {{frames, gap}, 3, "101.png"},
        {{frames, a}, 2, "folder"},
        {{a, a, "--fps", "90"}, 2, "--fps"},
        {{a, a, "--metric", "flipp"}, 2, "flip"},
        {{a, a, "--metric", "ssim", "--heat-map", folder.file("h.png")}, 2, "--heat-map"},
        {{a, a, "--heat-map", folder.file("no/folder.png")}, 3, "no/folder.png"},
        {{a, a, "--gaze", "left"}, 2, "left"},
        {{a, a, "--gaze", "trace:" + folder.file("none.csv")}, 3, "none.csv"},
        {{a, a, "--black", "101"}, 2, "101"},
        {{a, a, "--peak", "0"}, 2, "--peak"},
        {{a, a, "--display", "nothing"}, 2, "nothing"},
        {{a}, 2, "test"},
    };
    for (const Case& bad : cases) {
        const ProgramResult result = compare(bad.arguments);
        EXPECT_EQ(result.exit_code, bad.exit_code) << bad.said << '\n' << result.err;
        EXPECT_THAT(result.err, HasSubstr(bad.said));
        EXPECT_THAT(result.out, Not(HasSubstr("contrast ")));
    }
    EXPECT_EQ(compare({folder.file("tiny.png"), folder.file("tiny.png"), "--metric", "contrast"})
                  .exit_code,
              0);
}

}  // namespace
}  // namespace gazeloop::tests
