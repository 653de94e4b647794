// Scenes from files, as users run them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdint>
#include <fstream>

#include "tests/support/encoded_pictures.h"
#include "tests/support/gltf_file.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::tests {
namespace {

using testing::HasSubstr;

ProgramResult run_scene(const std::filesystem::path& scene, const std::string& method = "kfr") {
    return run_gazeloop({"run", "--scene", scene.string(), "--method", method, "--gaze",
                         "fixed:0,0", "--target", "headless", "--clock", "virtual", "--frames", "2",
                         "--spp", "1", "--set", "render.scale=0.05", "--hash"});
}

void write(const std::filesystem::path& file, std::span<const std::byte> bytes) {
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
}

/// A triangle of a material with a picture beside it.
GltfFile textured() {
    GltfFile file = one_triangle();
    file.document.merge_patch(nlohmann::json::parse(R"({"textures": [{"source": 0}],
        "images": [{"uri": "a.png"}], "materials": [{"doubleSided": true,
        "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]})"));
    auto& primitive = file.document["meshes"][0]["primitives"][0];
    primitive["material"] = 0;
    primitive["attributes"]["TEXCOORD_0"] = file.add_accessor<float>("VEC2", {0, 0, 1, 0, 0, 1});
    file.document["nodes"][0]["translation"] = {-0.5, 1.2, -2.0};
    return file;
}

TEST(SceneFiles, AreShownByEveryMethodTheSameWayTwice) {
    const TemporaryFolder folder;
    const std::vector<std::uint8_t> red{200, 0, 0, 255};
    write(folder / "a.png", encoded_png(1, 1, PNG_FORMAT_RGBA, red.data()));
    write(folder / "a.glb", textured().glb());
    for (const char* method : {"full", "kfr", "acuity"}) {
        const ProgramResult first = run_scene(folder / "a.glb", method);
        ASSERT_EQ(first.exit_code, 0) << first.err;
        EXPECT_THAT(first.err, HasSubstr("a.glb: 1 triangles in 1 instances, 1 pictures"));
        const auto hashes = [](const std::string& out) { return out.substr(out.find("hash ")); };
        EXPECT_EQ(hashes(first.out), hashes(run_scene(folder / "a.glb", method).out));
    }
}

TEST(SceneFiles, ThatCannotBeUsedEndTheRunWithThree) {
    const TemporaryFolder folder;
    write(folder / "missing.glb", textured().glb());
    ProgramResult result = run_scene(folder / "missing.glb");
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.err, HasSubstr("/images/0: "));
    EXPECT_THAT(result.err, HasSubstr("a.png cannot be read (No such file"));

    result = run_scene(folder / "nowhere.gltf");
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.err, HasSubstr("nowhere.gltf: cannot be read (No such file"));

    GltfFile draco = one_triangle();
    draco.document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    write(folder / "draco.glb", draco.glb());
    result = run_scene(folder / "draco.glb");
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.err, HasSubstr("requires \"KHR_draco_mesh_compression\""));
}

// The run, its report and a replay say the same of what the scene did without.
TEST(SceneFiles, TellWhatTheyDidWithout) {
    const TemporaryFolder folder;
    write(folder / "a.glb", one_triangle().glb());
    const std::string session = (folder / "a.gaze").string();
    const ProgramResult run =
        run_gazeloop({"run", "--scene", (folder / "a.glb").string(), "--gaze", "fixed:0,0",
                      "--target", "headless", "--clock", "virtual", "--frames", "2", "--record",
                      session, "--set", "render.scale=0.05", "--json", "-"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto parts = nlohmann::json::parse(run.out)["left_out"]["parts"];
    ASSERT_FALSE(parts.empty());
    const ProgramResult report = run_gazeloop({"report", session, "--json", "-"});
    ASSERT_EQ(report.exit_code, 0) << report.err;
    std::vector<nlohmann::json> told;
    const auto reported = nlohmann::json::parse(report.out);
    for (const auto& happening : reported["happenings"]) {
        if (happening["kind"] == "left-out") {
            told.push_back(happening["text"]);
        }
    }
    EXPECT_EQ(nlohmann::json(told), parts);
    const ProgramResult replay = run_gazeloop({"replay", session, "--json", "-"});
    ASSERT_EQ(replay.exit_code, 0) << replay.err;
    EXPECT_EQ(nlohmann::json::parse(replay.out)["left_out"]["parts"], parts);
}

TEST(SceneFiles, OfLightFieldsAreMadeAndShown) {
    const TemporaryFolder folder;
    const std::string out = (folder / "field").string();
    const ProgramResult made =
        run_gazeloop({"simulate", "light-field", out, "--views", "3", "--size", "32", "--scene",
                      "raymarch", "--spacing", "20"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(made.out, HasSubstr("views.lightfield: 9 views of 32x32 px"));
    for (const char* method : {"full", "kfr3d"}) {
        const ProgramResult shown = run_scene(folder / "field" / "views.lightfield", method);
        EXPECT_EQ(shown.exit_code, 0) << shown.err;
    }
    std::filesystem::remove(folder / "field" / "view_01_02.png");
    const ProgramResult missing = run_scene(folder / "field" / "views.lightfield");
    EXPECT_EQ(missing.exit_code, 3);
    EXPECT_THAT(missing.err, HasSubstr("view_01_02.png is missing"));
    const ProgramResult again = run_gazeloop({"simulate", "light-field", out});
    EXPECT_EQ(again.exit_code, 3);
    EXPECT_THAT(again.err, HasSubstr("it holds something already"));
}

TEST(SceneFiles, OfLightFieldsGoOnWhereTheirMakingWasInterrupted) {
    const TemporaryFolder folder;
    const std::vector<std::string> words{"simulate", "light-field", (folder / "other").string(),
                                         "--views",  "15",          "--size",
                                         "128",      "--scene",     "raymarch"};
    const ProgramResult stopped = run_gazeloop(
        words, {.trigger = "of 225 views", .on_trigger = [](int pid) { kill(pid, SIGINT); }});
    ASSERT_EQ(stopped.exit_code, 130) << stopped.err;
    EXPECT_THAT(stopped.err, HasSubstr("views are missing; the same command goes on with them"));
    std::vector<std::string> larger = words;
    larger[6] = "129";
    EXPECT_THAT(run_gazeloop(larger).err, HasSubstr("has 'size_px = 128', not 'size_px = 129'"));
    const ProgramResult gone_on = run_gazeloop(words);
    ASSERT_EQ(gone_on.exit_code, 0) << gone_on.err;
    EXPECT_THAT(gone_on.err, HasSubstr("of 225 views are there from before and are taken over"));
    EXPECT_FALSE(std::filesystem::exists(folder / "other" / "unfinished.txt"));
    EXPECT_EQ(run_gazeloop(words).exit_code, 3) << "it is finished";
}

// Rendered into the cache by the first run on a machine, which takes most of this test's time.
TEST(SceneFiles, OfTheBuiltInLightFieldAreThereByName) {
    const ProgramResult first = run_scene("lightfield", "kfr3d");
    ASSERT_EQ(first.exit_code, 0) << first.err;
    const ProgramResult again = run_scene("lightfield", "kfr3d");
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_THAT(again.err, testing::Not(HasSubstr("rendering its"))) << "the first one kept it";
    const auto hashes = [](const std::string& out) { return out.substr(out.find("hash ")); };
    EXPECT_EQ(hashes(again.out), hashes(first.out));
}

/// A light field of 225 views, 14 MiB, of which a viewer who goes past it sees 15 in a row.
std::string light_field_to_pass(const TemporaryFolder& folder) {
    const std::string out = (folder / "field").string();
    const ProgramResult made =
        run_gazeloop({"simulate", "light-field", out, "--views", "15", "--size", "128", "--scene",
                      "raymarch", "--spacing", "6"});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    return (folder / "field" / "views.lightfield").string();
}

/// A head passes over a light field that it sees through lenses without an opening.
ProgramResult pass_over(std::vector<std::string> words) {
    for (const char* const setting :
         {"render.scale=0.05", "render.camera=fly-6", "lightfield.aperture_m=0"}) {
        words.insert(words.end(), {"--set", setting});
    }
    return run_gazeloop(words);
}

// What a frame waited for and what was fetched ahead depends on the viewer's path alone: a replay
// does the same, and one that fetches nothing, or has room for all views, shows the same.
TEST(SceneFiles, OfLightFieldsThatDoNotFitAreReplayedBitByBit) {
    const TemporaryFolder folder;
    const std::string field = light_field_to_pass(folder);
    for (const std::string method : {"full", "kfr3d"}) {
        const std::string session = (folder / (method + ".gaze")).string();
        const ProgramResult run = pass_over({"run",
                                             "--scene",
                                             field,
                                             "--method",
                                             method,
                                             "--gaze",
                                             "sim",
                                             "--target",
                                             "headless",
                                             "--clock",
                                             "virtual",
                                             "--frames",
                                             "120",
                                             "--spp",
                                             "1",
                                             "--set",
                                             "lightfield.memory_mib=1",
                                             "--hash",
                                             "--record",
                                             session});
        ASSERT_EQ(run.exit_code, 0) << run.err;
        EXPECT_THAT(run.err, HasSubstr("225 views take 14 MiB, more than they may"));
        const auto account = [](const std::string& said) {
            const std::size_t at = said.find(" of 225 views at a time");
            if (at == std::string::npos) {
                return std::string();
            }
            // Which of the views that were fetched ahead were late is the machine's.
            const std::string line = said.substr(at - 2, said.find('\n', at) - at + 2);
            return line.substr(0, line.find(" of them asked for"));
        };
        EXPECT_THAT(account(run.err), HasSubstr("10 of 225 views")) << run.err;
        EXPECT_THAT(account(run.err), HasSubstr("frames waited for"));
        EXPECT_THAT(account(run.err), HasSubstr("views were fetched ahead, "));

        const ProgramResult again =
            run_gazeloop({"replay", session, "--hash", "--set", "lightfield.memory_mib=1"});
        ASSERT_EQ(again.exit_code, 0) << again.err;
        EXPECT_THAT(again.out, HasSubstr("pictures equal in 120 of 120 frames")) << method;
        EXPECT_EQ(account(again.err), account(run.err));

        const ProgramResult waiting =
            run_gazeloop({"replay", session, "--hash", "--set", "lightfield.memory_mib=1", "--set",
                          "lightfield.prefetch=false"});
        ASSERT_EQ(waiting.exit_code, 0) << waiting.err;
        EXPECT_THAT(waiting.out, HasSubstr("pictures equal in 120 of 120 frames")) << method;
        EXPECT_THAT(account(waiting.err), HasSubstr("12 of 225 views"));
        EXPECT_THAT(account(waiting.err), testing::Not(HasSubstr("ahead")));

        // What may be taken of memory is the machine's, and not recorded.
        const ProgramResult whole = run_gazeloop({"replay", session, "--hash"});
        ASSERT_EQ(whole.exit_code, 0) << whole.err;
        EXPECT_THAT(whole.out, HasSubstr("pictures equal in 120 of 120 frames")) << method;
        EXPECT_EQ(account(whole.err), "");

        const ProgramResult report = run_gazeloop({"report", session, "--json", "-"});
        ASSERT_EQ(report.exit_code, 0) << report.err;
        EXPECT_THAT(report.out, HasSubstr(account(run.err)));
    }
}

// A trade's times are those of passes: that frames waited before them is said.
TEST(SceneFiles, OfLightFieldsThatDoNotFitAreSaidToWaitInATrade) {
    const TemporaryFolder folder;
    const std::string field = light_field_to_pass(folder);
    const auto trade = [&](const char* memory_mib) {
        return pass_over({"trade",
                          "--scene",
                          field,
                          "--methods",
                          "kfr",
                          "--sigma",
                          "2",
                          "--alpha",
                          "4",
                          "--gaze",
                          "0,0",
                          "--frames",
                          "45",
                          "--rounds",
                          "1",
                          "--metric",
                          "psnr",
                          "--set",
                          fmt::format("lightfield.memory_mib={}", memory_mib),
                          "--json",
                          "-"});
    };
    const ProgramResult streamed = trade("1");
    ASSERT_EQ(streamed.exit_code, 0) << streamed.err;
    EXPECT_THAT(streamed.err, HasSubstr("of 90 timed frames waited for "));
    const auto points = nlohmann::json::parse(streamed.out).at("points");
    ASSERT_EQ(points.size(), 2U);
    std::uint64_t frames = 0;
    for (const auto& point : points) {
        EXPECT_EQ(point.at("timed_frames"), 45);
        EXPECT_GE(point.at("waited_views"), point.at("waited_frames"));
        frames += point.at("waited_frames").get<std::uint64_t>();
    }
    EXPECT_GT(frames, 0U);
    const ProgramResult whole = trade("64");
    ASSERT_EQ(whole.exit_code, 0) << whole.err;
    EXPECT_THAT(whole.err, testing::Not(HasSubstr("waited")));
    EXPECT_EQ(nlohmann::json::parse(whole.out).at("points")[0].at("waited_frames"), 0);
}

// Where the views wait must have room for them all, before any is decoded.
TEST(SceneFiles, OfLightFieldsThatDoNotFitNeedRoomOnADisk) {
    const TemporaryFolder folder;
    const std::string field = light_field_to_pass(folder);
    const std::vector<std::string> run{"run",
                                       "--scene",
                                       field,
                                       "--gaze",
                                       "fixed:0,0",
                                       "--target",
                                       "headless",
                                       "--frames",
                                       "2",
                                       "--set",
                                       "render.scale=0.05",
                                       "--set",
                                       "lightfield.aperture_m=0",
                                       "--set",
                                       "lightfield.memory_mib=1"};
    const std::string nowhere = (folder / "none").string();
    ProgramResult result = run_gazeloop(run, {.environment = {{"TMPDIR", nowhere}}});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.err, HasSubstr(nowhere + ": no scratch file"));
    EXPECT_THAT(result.err, HasSubstr("TMPDIR"));

    std::filesystem::create_directory(nowhere);
    result = run_gazeloop(
        run,
        {.environment = {{"TMPDIR", nowhere}},
         .wrapper = {"unshare", "--user", "--map-root-user", "--mount", "sh", "-c",
                     "mount -t tmpfs -o size=4m none '" + nowhere + "' && exec \"$@\"", "sh"}});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.err,
                HasSubstr(nowhere + ": no room for a scratch file of 15 MiB (No space left"));

    std::filesystem::resize_file(folder / "field" / "view_07_03.png", 900);
    result = run_gazeloop(run);
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.err, HasSubstr("view_07_03.png: "));
}

TEST(SceneFiles, NamesThatAreNeitherAreRefused) {
    const ProgramResult result = run_scene("galery");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr("did you mean 'gallery'"));
}

TEST(SceneFiles, InAConfigurationLieBesideIt) {
    const TemporaryFolder folder;
    write(folder / "a.glb", one_triangle().glb());
    std::ofstream(folder / "config.toml") << "[render]\nscene = \"a.glb\"\n";
    const ProgramResult result =
        run_gazeloop({"run", "--config", folder / "config.toml", "--print-config"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr((folder / "a.glb").string()));
}

}  // namespace
}  // namespace gazeloop::tests
