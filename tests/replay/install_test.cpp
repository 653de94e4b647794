// What `cmake --install` puts where, and that it works there without the sources and the build.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string content(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

class Installed : public testing::Test {
  protected:
    void SetUp() override {
        const ProgramResult result =
            run_program({GAZELOOP_CMAKE, "--install", GAZELOOP_BINARY_DIR, "--prefix", prefix_});
        ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
        fs::create_directories(folder_.file("home"));
        fs::create_directories(folder_.file("elsewhere"));
        fs::create_directories(folder_.file("empty"));
    }

    /// The installed program, in a folder of its own and for a user who has nothing of ours; where
    /// this machine lets us, with empty folders in the places of the sources and of the build. (A
    /// sanitizer's suppressions lie there, so that it sees them.)
    [[nodiscard]] ProgramResult run(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), prefix_ + "/bin/gazeloop");
        ProgramOptions options;
        options.environment = {{"HOME", folder_.file("home")},
                               {"XDG_CONFIG_HOME", ""},
                               {"XDG_CACHE_HOME", ""},
                               {"GAZELOOP_CACHE", ""}};
        options.wrapper = {"env", "-C", folder_.file("elsewhere")};
        if (can_hide()) {
            options.wrapper.insert(options.wrapper.end(),
                                   {"unshare", "--map-root-user", "--mount", "sh", "-c",
                                    hiding() + " && exec \"$@\"", "sh"});
        }
        return run_program(arguments, options);
    }

    ScratchFolder folder_;
    std::string prefix_ = folder_.file("prefix");

  private:
    [[nodiscard]] std::string hiding() const {
        const std::string mount = "mount --bind '" + folder_.file("empty") + "' ";
        // The build may lie in the sources, or not.
        return mount + "'" GAZELOOP_BINARY_DIR "' && " + mount + "'" GAZELOOP_SOURCE_DIR "'";
    }
    [[nodiscard]] bool can_hide() const {
#ifdef __SANITIZE_ADDRESS__
        return false;
#else
        return run_program({"unshare", "--map-root-user", "--mount", "sh", "-c", hiding()})
                   .exit_code == 0;
#endif
    }
};

TEST_F(Installed, IsTheProgramTheLayerTheUdevRulesAndTheFittedShapes) {
    std::vector<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(prefix_)) {
        if (!entry.is_directory()) {
            files.push_back(fs::relative(entry.path(), prefix_).string());
        }
    }
    std::vector<std::string> expected{
        "bin/gazeloop", "lib/libXrApiLayer_gazeloop.so", "include/openxr/gazeloop_gaze_sample.h",
        "lib/udev/rules.d/70-gazeloop.rules",
        "share/openxr/1/api_layers/implicit.d/XrApiLayer_gazeloop.json"};
    for (const auto& entry : fs::directory_iterator(GAZELOOP_SOURCE_DIR "/config/foveation")) {
        expected.push_back("share/gazeloop/foveation/" + entry.path().filename().string());
    }
    EXPECT_THAT(files, testing::UnorderedElementsAreArray(expected));
    const std::string rules = content(prefix_ + "/lib/udev/rules.d/70-gazeloop.rules");
    EXPECT_EQ(rules, content(GAZELOOP_SOURCE_DIR "/config/udev/70-gazeloop.rules"));
    EXPECT_THAT(rules, HasSubstr("054c"));
    const auto may = fs::status(prefix_ + "/lib/udev/rules.d/70-gazeloop.rules").permissions();
    EXPECT_NE(may & fs::perms::others_read, fs::perms::none);
}

TEST_F(Installed, FindsItsProfiles) {
    const ProgramResult version = run({"--version"});
    EXPECT_EQ(version.exit_code, 0) << version.err;
    EXPECT_THAT(version.out, HasSubstr(GAZELOOP_VERSION));
    for (const auto& [option, folder] :
         {std::pair{"--display", "displays"}, std::pair{"--tracker", "trackers"}}) {
        std::size_t profiles = 0;
        for (const auto& entry :
             fs::directory_iterator(GAZELOOP_SOURCE_DIR "/config/" + std::string(folder))) {
            const std::string name = entry.path().stem().string();
            const ProgramResult result = run({"run", option, name, "--print-config"});
            EXPECT_EQ(result.exit_code, 0) << name << ": " << result.err;
            EXPECT_THAT(result.out, HasSubstr(name));
            ++profiles;
        }
        EXPECT_GT(profiles, 2U) << folder;
    }
    const ProgramResult plan = run({"plan", "--display", "fove0", "--json", "-"});
    ASSERT_EQ(plan.exit_code, 0) << plan.err;
    EXPECT_EQ(nlohmann::json::parse(plan.out).at("display_pixels"), 1280 * 1440);
}

TEST_F(Installed, RendersRecordsAndReplays) {
    const std::string session = folder_.file("session.gaze");
    for (const char* const method : {"kfr", "full", "acuity"}) {
        const ProgramResult result =
            run({"run", "--target", "headless", "--frames", "3", "--method", method, "--set",
                 "render.scale=0.02", "--record", session});
        EXPECT_EQ(result.exit_code, 0) << method << ": " << result.err;
        EXPECT_EQ(run({"replay", session}).exit_code, 0) << method;
        fs::remove(session);
    }
}

}  // namespace
}  // namespace gazeloop::tests
