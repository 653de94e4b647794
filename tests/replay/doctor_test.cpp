// gazeloop doctor: this machine, and machines on which something is broken.
#include <gtest/gtest.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <set>

#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

using Environment = std::vector<std::pair<std::string, std::string>>;

struct Diagnosis {
    int exit_code = -1;
    nlohmann::json report;
    std::string err;

    /// The check's finding; null if there is none.
    [[nodiscard]] nlohmann::json operator[](const std::string& check) const {
        for (const nlohmann::json& finding : report.at("checks")) {
            if (finding.at("check") == check) {
                return finding;
            }
        }
        return nullptr;
    }
    [[nodiscard]] std::string verdict(const std::string& check) const {
        const nlohmann::json finding = (*this)[check];
        return finding.is_null() ? "absent" : finding.at("verdict").get<std::string>();
    }
};

Diagnosis diagnose(std::vector<std::string> arguments, const Environment& environment = {}) {
    arguments.insert(arguments.begin(), {"doctor", "--json"});
    const ProgramResult result = run_gazeloop(arguments, {.environment = environment});
    Diagnosis diagnosis{result.exit_code, nlohmann::json::parse(result.out, nullptr, false),
                        result.err};
    EXPECT_TRUE(diagnosis.report.is_object()) << result.out << result.err;
    return diagnosis;
}

class DoctorOnBadRuntime : public testing::Test {
  protected:
    [[nodiscard]] Diagnosis diagnose_runtime(const std::string& how,
                                             const std::vector<std::string>& arguments = {}) const {
        const std::string manifest = folder_.write(
            "runtime.json", R"({"file_format_version": "1.0.0", "runtime": {"library_path": ")" +
                                std::string(GAZELOOP_BAD_RUNTIME) + R"("}})");
        return diagnose(arguments, {{"XR_RUNTIME_JSON", manifest}, {"GAZELOOP_TEST_RUNTIME", how}});
    }

    ScratchFolder folder_;
};

TEST(Doctor, FindsThisMachineFit) {
    const Diagnosis diagnosis = diagnose({});
    EXPECT_EQ(diagnosis.exit_code, 0) << diagnosis.report.dump(2);
    EXPECT_EQ(diagnosis.report["loop_can_run"], true);
    for (const char* check :
         {"vulkan.loader", "vulkan.device.0", "vulkan.clock", "openxr.runtime", "openxr.extensions",
          "openxr.instance", "openxr.system", "openxr.eye_gaze.extension", "openxr.clock",
          "clock.monotonic", "recording.write"}) {
        EXPECT_EQ(diagnosis.verdict(check), "ok") << check;
    }
    EXPECT_EQ(diagnosis["vulkan.device.0"]["facts"]["requirements"]["dynamicRendering"], true);
    EXPECT_NE(diagnosis.verdict("openxr.session"), "failure");
    // Whatever is not ok says what to do; every check is named once.
    std::set<std::string> names;
    for (const nlohmann::json& finding : diagnosis.report["checks"]) {
        EXPECT_TRUE(names.insert(finding["check"]).second) << finding["check"];
        EXPECT_NE(finding["found"], "") << finding["check"];
        if (finding["verdict"] == "warning" || finding["verdict"] == "failure") {
            EXPECT_NE(finding["remedy"], "") << finding["check"];
        }
    }
}

TEST(Doctor, WarnsOfSoftwareRendering) {
    // Mesa's rasteriser, which ./dev test installs, also where there is a GPU.
    const Diagnosis diagnosis =
        diagnose({"--target", "headless", "--set", "vulkan.device=llvmpipe"});
    EXPECT_EQ(diagnosis["vulkan.choice"]["facts"]["software"], true);
    EXPECT_EQ(diagnosis.verdict("vulkan.choice"), "warning");
    EXPECT_NE(diagnosis["vulkan.choice"]["found"].get<std::string>().find("not real time"),
              std::string::npos);
}

TEST(Doctor, WritesForPeopleToo) {
    const ProgramResult result = run_gazeloop({"doctor", "--folder", "/tmp"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(result.out.starts_with("the loop can run; ")) << result.out;
    EXPECT_NE(result.out.find("ok       vulkan.loader"), std::string::npos) << result.out;
}

TEST(Doctor, SaysThatThereIsNoVulkanDriver) {
    const Diagnosis diagnosis = diagnose(
        {}, {{"VK_ICD_FILENAMES", "/nowhere/icd.json"}, {"VK_DRIVER_FILES", "/nowhere/icd.json"}});
    EXPECT_EQ(diagnosis.exit_code, 4);
    EXPECT_EQ(diagnosis.verdict("vulkan.loader"), "ok");
    EXPECT_EQ(diagnosis.verdict("vulkan.choice"), "failure");
    EXPECT_NE(diagnosis["vulkan.choice"]["remedy"].get<std::string>().find("VK_DRIVER_FILES"),
              std::string::npos);
    // The runtime fails for the same reason: it is not to blame.
    EXPECT_EQ(diagnosis["openxr.start"]["remedy"].get<std::string>().find("mend Vulkan first"), 0U)
        << diagnosis["openxr.start"];
}

TEST(Doctor, SurvivesAVulkanDriverThatCrashes) {
    const ScratchFolder folder;
    const std::string icd = folder.write(
        "icd.json", R"({"file_format_version": "1.0.0", "ICD": {"api_version": "1.3.0",)"
                    R"("library_path": ")" +
                        std::string(GAZELOOP_BAD_RUNTIME) + R"("}})");
    const Diagnosis diagnosis = diagnose(
        {},
        {{"VK_ICD_FILENAMES", icd}, {"VK_DRIVER_FILES", icd}, {"GAZELOOP_TEST_RUNTIME", "crash"}});
    EXPECT_EQ(diagnosis.exit_code, 4);
    EXPECT_EQ(diagnosis["vulkan.choice"]["found"],
              "loading the Vulkan drivers: crashed (SIGSEGV); its last words: bad runtime: about "
              "to crash");
}

TEST(Doctor, SaysThatTheNamedRuntimeIsNotThere) {
    const Environment missing{{"XR_RUNTIME_JSON", "/nowhere/runtime.json"}};
    const Diagnosis openxr = diagnose({}, missing);
    EXPECT_EQ(openxr.exit_code, 4);
    EXPECT_EQ(openxr.verdict("openxr.start"), "failure");
    EXPECT_NE(openxr["openxr.start"]["found"].get<std::string>().find("/nowhere/runtime.json"),
              std::string::npos);
    // Off screen nobody needs it.
    const Diagnosis headless = diagnose({"--target", "headless"}, missing);
    EXPECT_EQ(headless.exit_code, 0);
    EXPECT_EQ(headless.verdict("openxr.start"), "failure");
}

TEST(Doctor, SaysThatTheRuntimesFileIsBroken) {
    const ScratchFolder folder;
    for (const char* text : {"", "{", "[]", "{\"runtime\": 3}", "\xff\xfe\x00"}) {
        const std::string manifest = folder.write("runtime.json", text);
        const Diagnosis diagnosis = diagnose({}, {{"XR_RUNTIME_JSON", manifest}});
        EXPECT_EQ(diagnosis.exit_code, 4) << text;
        EXPECT_EQ(diagnosis.verdict("openxr.runtime"), "ok") << text;
        EXPECT_EQ(diagnosis.verdict("openxr.start"), "failure") << text;
    }
}

TEST_F(DoctorOnBadRuntime, Crashes) {
    const Diagnosis diagnosis = diagnose_runtime("crash");
    EXPECT_EQ(diagnosis.exit_code, 4);
    EXPECT_EQ(diagnosis["openxr.start"]["found"],
              "loading the OpenXR runtime: crashed (SIGSEGV); its last words: bad runtime: about "
              "to crash");
    EXPECT_EQ(diagnosis.verdict("recording.write"), "ok") << "the other checks go on";
}

TEST_F(DoctorOnBadRuntime, Hangs) {
    const Diagnosis diagnosis = diagnose_runtime("hang", {"--patience", "2"});
    EXPECT_EQ(diagnosis.exit_code, 4);
    EXPECT_NE(diagnosis["openxr.start"]["found"].get<std::string>().find(
                  "loading the OpenXR runtime: hung: no end after 2.0 s"),
              std::string::npos)
        << diagnosis["openxr.start"];
}

TEST_F(DoctorOnBadRuntime, EndsTheProcess) {
    const Diagnosis diagnosis = diagnose_runtime("exit");
    EXPECT_EQ(diagnosis.exit_code, 4);
    EXPECT_NE(
        diagnosis["openxr.start"]["found"].get<std::string>().find("ended itself (exit code 7)"),
        std::string::npos);
}

TEST_F(DoctorOnBadRuntime, IsNoRuntime) {
    const Diagnosis diagnosis = diagnose_runtime("");
    EXPECT_EQ(diagnosis.exit_code, 4);
    EXPECT_NE(diagnosis["openxr.start"]["found"].get<std::string>().find("XR_ERROR"),
              std::string::npos)
        << diagnosis["openxr.start"];
}

TEST(Doctor, ReadsEveryLayerOfTheConfiguration) {
    const ScratchFolder folder;
    const std::string good = folder.write("good.toml", "[target]\nname = \"headless\"\n");
    const std::string bad = folder.write("bad.toml", "[kfr]\nsgima = 2\n");
    const Environment nobody{{"XDG_CONFIG_HOME", folder.file("")}};
    const Diagnosis diagnosis = diagnose({"--config", good, "--config", bad}, nobody);
    EXPECT_EQ(diagnosis.exit_code, 4) << "run would refuse the second file";
    EXPECT_EQ(diagnosis.report["target"], "headless");
    EXPECT_EQ(diagnosis.verdict("configuration.user"), "not applicable");
    EXPECT_EQ(diagnosis.verdict("configuration.file.0"), "ok");
    EXPECT_EQ(diagnosis.verdict("configuration.file.1"), "failure");
    EXPECT_NE(diagnosis["configuration.file.1"]["found"].get<std::string>().find(bad + ":2"),
              std::string::npos);
}

// Whatever `run` refuses stops the loop.
TEST(Doctor, SaysWhichSettingsRunWouldRefuse) {
    const ScratchFolder folder;
    const std::string table = folder.write("table.toml", "kfr.kernel = \"table\"\n");
    const std::string no_table = folder.write(
        "no_table.toml", "kfr.kernel = \"table\"\nkfr.kernel_table = \"nosuch.csv\"\n");
    const std::string display = folder.write("display.toml", "profile.display = \"fove1\"\n");
    const std::vector<std::vector<std::string>> refused{
        {"--set", "gaze.hold_ms=1"}, {"--tracker", "nosuch"},
        {"--config", table},         {"--config", no_table},
        {"--config", display},       {"--target", "openxr", "--set", "vulkan.device=llvm"}};
    for (std::vector<std::string> arguments : refused) {
        const Diagnosis diagnosis = diagnose(arguments);
        EXPECT_EQ(diagnosis.exit_code, 4) << arguments[1];
        EXPECT_EQ(diagnosis.verdict("configuration.settings"), "failure") << arguments[1];
        EXPECT_EQ(diagnosis.report["loop_can_run"], false) << arguments[1];
        EXPECT_NE(diagnosis.verdict("vulkan.loader"), "absent") << "the rest is said too";
        arguments.insert(arguments.begin(), {"run", "--frames", "1"});
        EXPECT_NE(run_gazeloop(arguments).exit_code, 0) << arguments[4];
    }
    EXPECT_EQ(diagnose({"--target", "headless"}).verdict("configuration.settings"), "ok");
}

TEST(Doctor, SaysWhatToDoAboutADeviceThatIsNotThere) {
    const ScratchFolder folder;
    const std::string file = folder.write("a.toml", "vulkan.device = \"Voodoo\"\n");
    const Diagnosis diagnosis = diagnose({"--target", "headless", "--config", file});
    EXPECT_EQ(diagnosis.exit_code, 4);
    const nlohmann::json choice = diagnosis["vulkan.choice"];
    EXPECT_NE(choice["found"].get<std::string>().find(file + ":1: vulkan.device = 'Voodoo'"),
              std::string::npos)
        << choice;
    EXPECT_EQ(choice["remedy"].get<std::string>().find("let vulkan.device be part of the name"), 0U)
        << choice;
}

TEST(Doctor, SaysThatANamedConfigurationIsNotThere) {
    const Diagnosis diagnosis =
        diagnose({"--target", "headless", "--config", "/nowhere/config.toml"});
    EXPECT_EQ(diagnosis.exit_code, 4);
    EXPECT_EQ(diagnosis.verdict("configuration.file.0"), "failure");
}

TEST(Doctor, SaysThatARecordingFolderIsOfNoUse) {
    const Diagnosis diagnosis = diagnose({"--folder", "/proc"});
    EXPECT_EQ(diagnosis.exit_code, 0) << "the loop can run without recording";
    EXPECT_EQ(diagnosis.verdict("recording.write"), "failure");
}

TEST(Doctor, LooksWhereItIsTold) {
    const ScratchFolder root;
    const Diagnosis diagnosis = diagnose({"--root", root.file("")});
    EXPECT_EQ(diagnosis.verdict("scheduling.governor"), "not applicable");
}

}  // namespace
}  // namespace gazeloop::tests
