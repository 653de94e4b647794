// Whole programs under `gazeloop layer run`, as users start them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "runtime/openxr_layer/provided_extensions.h"
#include "runtime/session/session_file.h"
#include "tests/support/cache_folder.h"
#include "tests/support/openxr_validation.h"
#include "tests/support/preload.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class LayerPrograms : public testing::Test {
  protected:
    /// In a home of its own.
    ProgramResult layer(const std::vector<std::string>& words, Environment more = {}) {
        for (const auto& [name, folder] : {std::pair{"HOME", "home"},
                                           {"XDG_CONFIG_HOME", "home/config"},
                                           {"XDG_STATE_HOME", "home/state"},
                                           {"XDG_DATA_HOME", "home/data"}}) {
            more.emplace_back(name, folder_.file(folder));
        }
        more.emplace_back("XDG_CACHE_HOME", cache_);
        std::vector<std::string> all{"layer"};
        all.insert(all.end(), words.begin(), words.end());
        return run_gazeloop(all, {.environment = more});
    }

    /// Monado for a program that no program of ours starts, and the same home.
    [[nodiscard]] Environment monado(const Environment& more = {}) const {
        Environment environment{
            {"HOME", folder_.file("home")},
            {"XDG_CONFIG_HOME", folder_.file("home/config")},
            {"XDG_STATE_HOME", folder_.file("home/state")},
            {"XDG_DATA_HOME", folder_.file("home/data")},
            {"XR_RUNTIME_JSON", cache_folder() + "/monado/share/openxr/1/openxr_monado.json"},
            {"SIMULATED_ENABLE", "1"},
            {"XRT_COMPOSITOR_NULL", "1"},
            {"OXR_NO_PRINTING", "1"}};
        environment.insert(environment.end(), more.begin(), more.end());
        return environment;
    }
    /// The extensions that applications of this environment are offered.
    [[nodiscard]] static std::string offered(const Environment& environment) {
        const ProgramResult list =
            run_program({"openxr_runtime_list"}, {.environment = environment});
        EXPECT_EQ(list.exit_code, 0) << list.err;
        return list.out;
    }

    ScratchFolder folder_;
    /// Where ./dev has built Monado, whatever the home.
    std::string cache_ = std::filesystem::path(cache_folder()).parent_path().string();
};

TEST_F(LayerPrograms, RecordsOneThatKnowsNothingOfIt) {
    const std::string file = folder_.file("hello.gaze");
    // It runs until it is given a line.
    const ProgramResult result = layer({"run", "--gaze", "sim", "--record", file, "--", "sh", "-c",
                                        "sleep 2 | hello_xr -g Vulkan2"});
    ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
    const session::SessionFile session = value_or_throw(session::read_session(file));
    ASSERT_GT(session.frames.size(), 10U);
    EXPECT_GT(session.samples.size(), 50U);
    std::size_t drawn = 0;
    std::size_t with_gaze = 0;
    for (const session::RecordedFrame& recorded : session.frames) {
        const frame::FrameRecord& frame = recorded.frame;
        EXPECT_GE(frame.stamps.begin.ns, frame.stamps.wake_up.ns);
        EXPECT_GE(frame.stamps.end_frame.ns, frame.stamps.submit.ns);
        EXPECT_GE(frame.stamps.submit.ns, frame.stamps.latch.ns);
        EXPECT_EQ(frame.stamps.display.kind, time::StampKind::Predicted);
        drawn += frame.should_render ? 1 : 0;
        with_gaze += frame.fovea.eyes[0].state == gaze::FoveaState::Tracking ? 1 : 0;
    }
    EXPECT_GT(drawn, session.frames.size() / 2);
    EXPECT_GT(with_gaze, drawn / 2);

    const std::string json = folder_.file("report.json");
    const ProgramResult report = run_gazeloop({"report", file, "--json", json});
    EXPECT_EQ(report.exit_code, 0) << report.err;
    EXPECT_THAT(report.out, HasSubstr("eye-to-photon"));
    const ProgramResult status = layer({"status"});
    EXPECT_THAT(status.out, HasSubstr("hello_xr"));
    EXPECT_THAT(status.out, HasSubstr(file));
    // Its first frames may show nothing, and then have no views.
    const ProgramResult replay = run_gazeloop({"replay", file, "--set", "render.scale=0.05"});
    EXPECT_EQ(replay.exit_code, 0) << replay.err;
    EXPECT_THAT(replay.out, HasSubstr("drew what the OpenXR API layer recorded"));
}

/// gazeloop itself is an application that reads the gaze of its runtime; the validation layer
/// stands above the layer, and sees all that it says.
TEST_F(LayerPrograms, GivesGazeToOneThatReadsIt) {
    const std::string session_file = folder_.file("session.gaze");
    const std::string validation_file = folder_.file("validation.txt");
    Environment environment{{"XR_ENABLE_API_LAYERS", "XR_APILAYER_LUNARG_core_validation"}};
    for (const auto& variable : openxr_validation_to(validation_file)) {
        environment.push_back(variable);
    }
    const ProgramResult result =
        layer({"run", "--gaze", "sim", "--", std::string(GAZELOOP_BINARY_DIR) + "/gazeloop", "run",
               "--gaze", "openxr", "--frames", "60", "--record", session_file, "--set",
               "render.scale=0.05"},
              environment);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out + result.err, HasSubstr(kOpenXrValidationIsOn));
    EXPECT_EQ(openxr_validation_messages(validation_file), "");
    const session::SessionFile session = value_or_throw(session::read_session(session_file));
    ASSERT_GT(session.samples.size(), 30U);
    const auto measured = std::ranges::count_if(session.samples, [](const auto& one) {
        return one.sample.sampled.kind == time::StampKind::Measured;
    });
    EXPECT_GT(measured, std::ssize(session.samples) / 2);
    EXPECT_THAT(layer({"status"}).out, HasSubstr("first read"));
}

TEST_F(LayerPrograms, RefusesSourcesAndApplicationsThatAreNotThere) {
    for (const char* const command : {"enable", "run"}) {
        std::vector<std::string> words{command, "--gaze", "telepathy"};
        if (std::string_view(command) == "run") {
            words.insert(words.end(), {"--", "true"});
        }
        const ProgramResult unknown = layer(words);
        EXPECT_EQ(unknown.exit_code, 2) << command;
        EXPECT_THAT(unknown.err, HasSubstr("telepathy"));
        words[2] = "trace:/nowhere.csv";
        const ProgramResult absent = layer(words);
        EXPECT_EQ(absent.exit_code, 3) << command << absent.err;
        EXPECT_THAT(absent.err, HasSubstr("/nowhere.csv"));
    }
    EXPECT_EQ(layer({"enable", "--gaze", "openxr"}).exit_code, 2);  // it is the runtime's own
    EXPECT_THAT(layer({"status"}).out, HasSubstr("off: gazeloop layer enable"));
    const ProgramResult allowed = layer({"allow", "/nowhere/program"});
    EXPECT_EQ(allowed.exit_code, 3);
    EXPECT_THAT(allowed.err, HasSubstr("/nowhere/program"));
    const ProgramResult forgotten = layer({"forget", "/nowhere/program"});
    EXPECT_EQ(forgotten.exit_code, 0);
    EXPECT_NE(forgotten.out.find("/nowhere/program: nothing was decided on it"), std::string::npos)
        << forgotten.out;
}

TEST_F(LayerPrograms, IsSwitchedOnAndOffForTheUser) {
    EXPECT_THAT(layer({"status"}).out, HasSubstr("off: gazeloop layer enable"));
    EXPECT_EQ(layer({"enable", "--gaze", "telepathy", "--set", "layer.nothing=1"}).exit_code, 2);
    const ProgramResult enabled = layer({"enable", "--gaze", "fixed:3,4"});
    ASSERT_EQ(enabled.exit_code, 0) << enabled.err;
    EXPECT_THAT(enabled.out, HasSubstr("on for this user"));
    EXPECT_THAT(enabled.out, HasSubstr("fixed:3,4"));
    // No program of ours is asked for it any more.
    const std::string list = offered(monado());
    for (const auto& [name, version] : openxr_layer::kProvidedExtensions) {
        const std::string entry = std::string(name) + " ";
        const std::size_t at = list.find(entry);
        ASSERT_NE(at, std::string::npos) << name << "\n" << list;
        EXPECT_EQ(list.find(entry, at + 1), std::string::npos) << name << " is listed once";
    }
    const auto json = nlohmann::json::parse(layer({"status", "--json"}).out);
    EXPECT_EQ(json["enabled_for_user"], true);
    EXPECT_EQ(json["gaze"], "fixed:3,4");
    EXPECT_EQ(json["applications"].size(), 1U);
    EXPECT_EQ(layer({"disable"}).exit_code, 0);
    EXPECT_THAT(offered(monado()), Not(HasSubstr("XR_GAZELOOP_gaze_sample")));
}

/// What `layer enable` lists and what is built and installed is one list.
TEST_F(LayerPrograms, ListTheSameExtensionsInEveryManifest) {
    std::ifstream in(GAZELOOP_BINARY_DIR "/openxr_layer/XrApiLayer_gazeloop.json");
    const auto manifest = nlohmann::json::parse(in);
    std::vector<std::string> listed;
    for (const auto& one : manifest.at("api_layer").at("instance_extensions")) {
        listed.push_back(one.at("name").get<std::string>() + " " +
                         one.at("extension_version").get<std::string>());
    }
    std::vector<std::string> provided;
    provided.reserve(std::size(openxr_layer::kProvidedExtensions));
    for (const auto& [name, version] : openxr_layer::kProvidedExtensions) {
        provided.push_back(std::string(name) + " " + std::to_string(version));
    }
    EXPECT_EQ(listed, provided);
}

/// As packages install it: nothing is enabled, and one variable is set.
TEST_F(LayerPrograms, AreGivenTheInstalledLayerByAVariable) {
    const std::string prefix = folder_.file("prefix");
    const ProgramResult installed =
        run_program({GAZELOOP_CMAKE, "--install", GAZELOOP_BINARY_DIR, "--prefix", prefix});
    ASSERT_EQ(installed.exit_code, 0) << installed.out << installed.err;
    const std::pair searched{std::string("XDG_DATA_DIRS"), prefix + "/share:/usr/share"};
    const std::pair on{std::string("GAZELOOP_LAYER"), std::string("1")};
    const std::pair off{std::string("GAZELOOP_LAYER_DISABLE"), std::string("1")};
    EXPECT_THAT(offered(monado({searched})), Not(HasSubstr("XR_GAZELOOP_gaze_sample")));
    EXPECT_THAT(offered(monado({searched, on})), HasSubstr("XR_GAZELOOP_gaze_sample"));
    EXPECT_THAT(offered(monado({searched, on, off})), Not(HasSubstr("XR_GAZELOOP_gaze_sample")));

    // The installed program knows where its layer lies; who searches elsewhere is helped.
    Environment environment = monado();
    environment.emplace_back("XDG_CACHE_HOME", cache_);
    const std::vector<std::string> run{
        prefix + "/bin/gazeloop", "layer", "run", "--gaze", "fixed:3,4", "--",
        "openxr_runtime_list"};
    const ProgramResult under = run_program(run, {.environment = environment});
    EXPECT_EQ(under.exit_code, 0) << under.err;
    EXPECT_THAT(under.out, HasSubstr("XR_GAZELOOP_gaze_sample"));
    const ProgramResult status =
        run_program({prefix + "/bin/gazeloop", "layer", "status"}, {.environment = environment});
    EXPECT_THAT(status.out, HasSubstr("openxr_runtime_list"));
}

TEST_F(LayerPrograms, SaysWhatItCannotRun) {
    EXPECT_EQ(layer({"run", "--", "/no/such/program"}).exit_code, 3);
    EXPECT_EQ(layer({"run"}).exit_code, 2);
    EXPECT_EQ(layer({"run", "--set", "layer.eye_gaze=sometimes", "--", "true"}).exit_code, 2);
}

}  // namespace
}  // namespace gazeloop::tests
