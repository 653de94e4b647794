// Whatever is wrong outside is said with the thing, the place and the remedy, and the right code.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

struct BadInput {
    const char* name;
    std::vector<std::string> arguments;
    int exit_code;
    const char* message;
};

void PrintTo(const BadInput& at, std::ostream* out) { *out << at.name; }

class Refuses : public testing::TestWithParam<BadInput> {};

TEST_P(Refuses, WithMessageAndCode) {
    const ProgramResult result = run_gazeloop(GetParam().arguments);
    EXPECT_EQ(result.exit_code, GetParam().exit_code) << result.err;
    EXPECT_NE(result.err.find(GetParam().message), std::string::npos) << result.err;
}

INSTANTIATE_TEST_SUITE_P(
    BadInput, Refuses,
    testing::Values(
        BadInput{"no_command", {}, 2, "subcommand"},
        BadInput{"unknown_command", {"ruin"}, 2, "did you mean 'run'"},
        BadInput{"unknown_flag",
                 {"run", "--sgima", "2"},
                 2,
                 "unknown option '--sgima'; did you mean '--sigma'?; gazeloop run --help"},
        BadInput{"unknown_flag_of_a_part",
                 {"simulate", "gaze", "x.csv", "--secnds=2"},
                 2,
                 "unknown option '--secnds'; did you mean '--seconds'?; gazeloop simulate gaze"},
        BadInput{"one_word_too_many", {"report", "a", "b"}, 2, "'b' was not expected"},
        BadInput{"half_a_frame", {"run", "--frames", "1.5"}, 2, "'1.5' must be a whole number"},
        BadInput{"option_twice",
                 {"run", "--gaze", "fixed:0,0", "--gaze", "sim"},
                 2,
                 "--gaze: it is given 2 times (fixed:0,0, sim): leave one"},
        BadInput{"device_in_virtual_time",
                 {"run", "--gaze", "osc:9321", "--clock", "virtual", "--target", "headless"},
                 2,
                 "--gaze osc:9321: a device's samples come in real time"},
        BadInput{"fewer_than_no_frames", {"run", "--frames", "-1"}, 2, "must be a whole number"},
        BadInput{"too_many_frames",
                 {"run", "--frames", "1000000000000001"},
                 2,
                 "must be a whole number, at most"},
        BadInput{"display_file_in_capitals",
                 {"run", "--display", "./My.TOML"},
                 2,
                 "'./My.TOML': the name of a display profile's file must end in .toml"},
        BadInput{"display_nowhere",
                 {"run", "--display", "/nowhere/d.toml"},
                 3,
                 "cannot be read (No such file"},
        BadInput{"scene_of_another_kind",
                 {"run", "--target", "headless", "--scene", "p.png", "--frames", "1"},
                 2,
                 "or a file whose name ends in .gltf, .glb"},
        BadInput{
            "layers_without_a_middle",
            {"plan", "--method", "layers", "--set", "layers.n=2", "--set", "layers.s2_fixed=true"},
            2,
            "set layers.n to 3 or 4, or layers.s2_fixed to false"},
        BadInput{"no_sigma", {"trade", "--sigma", ""}, 2, "a name is needed"},
        BadInput{"sigma_that_is_none", {"trade", "--sigma", "1,nan"}, 2, "kfr.sigma"},
        BadInput{"label_of_no_bids", {"convert", "a", "b", "--subject", "7"}, 2, "add --to bids"},
        BadInput{"table_on_stdout", {"convert", "a", "-"}, 2, "/dev/stdout"},
        BadInput{"trace_nowhere",
                 {"simulate", "gaze", "/nowhere/x.csv"},
                 3,
                 "/nowhere/x.csv: cannot be written (No such file"},
        BadInput{"table_without_kernel",
                 {"run", "--set", "kfr.kernel_table=/nowhere/k.csv"},
                 2,
                 "--set): has no effect while kfr.kernel = power (built-in): set "
                 "kfr.kernel=table too"},
        BadInput{"polynomial_without_kernel",
                 {"plan", "--set", "kfr.polynomial=1"},
                 2,
                 "set kfr.kernel=polynomial too"},
        BadInput{"missing_trace", {"replay", "/nowhere/gaze.csv"}, 3, "/nowhere/gaze.csv"},
        BadInput{"trace_is_a_folder", {"replay", "/tmp"}, 3, "/tmp"},
        BadInput{"missing_session", {"report", "/nowhere/session"}, 3, "/nowhere/session"},
        BadInput{"display", {"run", "--display", "fove1"}, 2, "did you mean 'fove0'"},
        BadInput{"display_file", {"run", "--display", "/nowhere/x.toml"}, 3, "/nowhere/x.toml"},
        BadInput{"budget", {"run", "--budget", "strickt"}, 2, "did you mean 'strict'"},
        BadInput{"budget_file", {"run", "--budget", "/nowhere/b.toml"}, 3, "/nowhere/b.toml"},
        BadInput{"budget_of_a_report", {"report", "x", "--budget", "strickt"}, 2, "'strict'"},
        BadInput{"two_budgets",
                 {"report", "x", "--budget", "strict", "--budget-ms", "3"},
                 2,
                 "--budget excludes --budget-ms"},
        BadInput{"no_budget_at_all", {"report", "x", "--budget-ms", "0"}, 2, "must be a number in"},
        BadInput{"budget_nan", {"report", "x", "--budget-ms", "nan"}, 2, "must be a number in"},
        BadInput{"monitor_nowhere",
                 {"run", "--monitor-json", "973"},
                 2,
                 "file descriptor 973 is not open (Bad file descriptor)"},
        BadInput{"monitor_by_name", {"run", "--monitor-json", "x"}, 2, "'x' must be the number of"},
        BadInput{"monitor_input", {"run", "--monitor-json", "0"}, 2, "is not open for writing"},
        BadInput{
            "monitor_window", {"run", "--set", "monitor.window_s=31"}, 2, "must lie in [0, 30]"},
        BadInput{"method", {"run", "--method", "kfrr"}, 2, "did you mean 'kfr'"},
        BadInput{"scene", {"run", "--scene", "raymarsh"}, 2, "did you mean 'raymarch'"},
        BadInput{"target", {"run", "--target", "openrx"}, 2, "did you mean 'openxr'"},
        BadInput{"key", {"run", "--set", "kfr.sgima=2"}, 2, "did you mean 'kfr.sigma'"},
        BadInput{"key_of_a_group",
                 {"run", "--set", "rings.nothing=2"},
                 2,
                 "unknown key 'rings.nothing'; known: rings.inner_deg, rings.outer_deg, "
                 "rings.tile_px\n"},
        BadInput{"key_of_no_group",
                 {"run", "--set", "x.y=2"},
                 2,
                 "unknown key 'x.y'; known: acuity.*, fixed.*, gaze.*, governor.*, hid.*, "
                 "interleaved.*, kfr.*"},
        BadInput{"useless_map",
                 {"run", "--target", "headless", "--frames", "1", "--set", "kfr.lp_width=2"},
                 2,
                 "kfr draws nothing worth seeing"},
        BadInput{"table_without_end",
                 {"run", "--target", "headless", "--set", "kfr.kernel=table", "--set",
                  "kfr.kernel_table=/dev/zero"},
                 3,
                 "/dev/zero: a table of a kernel has at most 1 MiB"},
        BadInput{"mark_without_pictures", {"run", "--mark-fovea"}, 2, "requires --snapshot"},
        BadInput{"trace_to_stdout", {"simulate", "gaze", "-"}, 2, "/dev/stdout"},
        BadInput{"page_to_nowhere",
                 {"numerics", "--html", "/nowhere/x.html"},
                 3,
                 "/nowhere/x.html: cannot be written"},
        BadInput{"no_value", {"run", "--set", "kfr.sigma"}, 2, "KEY=VALUE"},
        BadInput{"flag_value", {"run", "--set", "kfr.disc=yes"}, 2, "true or false"},
        BadInput{"hold_below_stale",
                 {"run", "--set", "gaze.hold_ms=50"},
                 2,
                 "gaze.hold_ms = 50 (--set): is less than gaze.stale_ms = 100 (built-in)"},
        BadInput{"stale_above_hold",
                 {"run", "--set", "gaze.stale_ms=301"},
                 2,
                 "set gaze.hold_ms to 301 or more, or gaze.stale_ms to 300 or less"},
        BadInput{"sigma_small", {"run", "--sigma", "0.4"}, 2, "must lie in [0.5, 32]"},
        BadInput{"sigma_nan", {"run", "--sigma", "nan"}, 2, "kfr.sigma = nan"},
        BadInput{"kernel", {"run", "--set", "kfr.kernel=sine"}, 2, "did you mean 'sin'"},
        BadInput{"polynomial_falls",
                 {"run", "--target", "headless", "--frames", "1", "--set", "kfr.kernel=polynomial",
                  "--set", "kfr.polynomial=-1,2"},
                 2,
                 "falls at x = 0"},
        BadInput{"polynomial_words",
                 {"run", "--target", "headless", "--frames", "1", "--set", "kfr.kernel=polynomial",
                  "--set", "kfr.polynomial=half,half"},
                 2,
                 "numbers with commas"},
        BadInput{"kernel_table_missing",
                 {"run", "--target", "headless", "--frames", "1", "--set", "kfr.kernel=table"},
                 2,
                 "kfr.kernel_table"},
        BadInput{"kernel_table_nowhere",
                 {"run", "--target", "headless", "--frames", "1", "--set", "kfr.kernel=table",
                  "--set", "kfr.kernel_table=/nowhere/k.csv"},
                 3,
                 "/nowhere/k.csv: the kernel's table cannot be read (No such file"},
        BadInput{"kernel_samples_fall",
                 {"run", "--target", "headless", "--frames", "1", "--set", "kfr.kernel=table",
                  "--set", "kfr.kernel_samples=0,0;0.5,0.7;0.6,0.6;1,1"},
                 3,
                 "--set: kfr.kernel_samples: sample:3: (0.6, 0.6) follows (0.5, 0.7)"},
        BadInput{"sigma_comma", {"run", "--sigma", "1,8"}, 2, "not a number"},
        BadInput{"alpha_large", {"run", "--alpha", "17"}, 2, "must lie in [0.25, 16]"},
        BadInput{"spp", {"run", "--spp", "17"}, 2, "must lie in [1, 16]"},
        BadInput{"gaze", {"run", "--gaze", "trance:x"}, 2, "trace:FILE"},
        BadInput{"fixed_gaze", {"run", "--gaze", "fixed:1"}, 2, "gaze '1': give"},
        BadInput{"config_file", {"run", "--config", "/nowhere/c.toml"}, 3, "/nowhere/c.toml"},
        BadInput{"frames_negative", {"run", "--frames", "-1"}, 2, "--frames"},
        BadInput{"frames_huge", {"run", "--frames", "99999999999999999999"}, 2, "--frames"},
        BadInput{"seconds_nan", {"run", "--seconds", "nan"}, 2, "--seconds"},
        BadInput{"speed_nan", {"replay", "x", "--speed", "nan"}, 2, "--speed"},
        BadInput{"rate_nan", {"simulate", "gaze", "x", "--rate", "nan"}, 2, "--rate"},
        BadInput{"empty_record", {"run", "--record", ""}, 2, "--record"},
        BadInput{"config_is_a_folder", {"run", "--config", "/tmp"}, 3, "/tmp"},
        BadInput{"device_over_openxr",
                 {"run", "--target", "openxr", "--set", "vulkan.device=x"},
                 2,
                 "--target headless"},
        BadInput{"snapshot_folder",
                 {"run", "--target", "headless", "--snapshot", "/dev/null/x"},
                 3,
                 "/dev/null/x"},
        BadInput{"speed", {"replay", "x", "--speed", "0"}, 2, "--speed"},
        BadInput{"no_vulkan_device_of_that_name",
                 {"run", "--target", "headless", "--set", "vulkan.device=Voodoo"},
                 4,
                 "llvmpipe"}),
    [](const auto& instance) { return instance.param.name; });

TEST(BadInput, TraceNamesFileAndLine) {
    const ScratchFolder folder;
    const std::string file = folder.file("gaze.csv");
    ASSERT_EQ(run_gazeloop({"simulate", "gaze", file, "--seconds", "0.1"}).exit_code, 0);
    const std::string broken = "sed -i '4s/^[0-9]*,//' '" + file + "'";
    ASSERT_EQ(std::system(broken.c_str()), 0);
    const ProgramResult result = run_gazeloop({"replay", file});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_NE(result.err.find(file + ":4"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("27 columns, the header has 28"), std::string::npos) << result.err;
}

TEST(BadInput, TraceWithoutGaze) {
    const ScratchFolder folder;
    const std::string file = folder.write("gaze.csv", "time,pupil\n1,2\n");
    const ProgramResult result = run_gazeloop({"replay", file});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_NE(result.err.find(file), std::string::npos) << result.err;
}

TEST(BadInput, ConfigurationNamesFileAndLine) {
    const ScratchFolder folder;
    const std::string syntax = folder.write("a.toml", "[kfr]\nsigma = = 2\n");
    const ProgramResult first = run_gazeloop({"run", "--config", syntax});
    EXPECT_EQ(first.exit_code, 3);
    EXPECT_NE(first.err.find(syntax + ":2"), std::string::npos) << first.err;
    const std::string key = folder.write("b.toml", "[kfr]\nsigma = 2.0\nalhpa = 3\n");
    const ProgramResult second = run_gazeloop({"run", "--config", key});
    EXPECT_EQ(second.exit_code, 2);
    EXPECT_NE(second.err.find(key + ":3"), std::string::npos) << second.err;
    EXPECT_NE(second.err.find("did you mean 'kfr.alpha'"), std::string::npos) << second.err;
    const std::string range = folder.write("c.toml", "kfr.sigma = 99\n");
    const ProgramResult third = run_gazeloop({"run", "--config", range});
    EXPECT_EQ(third.exit_code, 2);
    EXPECT_NE(third.err.find("must lie in [0.5, 32]"), std::string::npos) << third.err;
}

TEST(BadInput, DisplayProfileNamesWhatIsMissing) {
    const ScratchFolder folder;
    const std::string file = folder.write("d.toml", "width_px = 100\nheight_px = 100\n");
    const ProgramResult result = run_gazeloop({"run", "--display", file});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_NE(result.err.find(file + ": refresh_hz"), std::string::npos) << result.err;
}

TEST(BadInput, NoVulkanDevice) {
    const ProgramResult result =
        run_gazeloop({"run", "--target", "headless", "--frames", "1"},
                     {.environment = {{"VK_ICD_FILENAMES", "/nowhere/icd.json"},
                                      {"VK_DRIVER_FILES", "/nowhere/icd.json"}}});
    EXPECT_EQ(result.exit_code, 4) << result.err;
    EXPECT_NE(result.err.find("VK_DRIVER_FILES names '/nowhere/icd.json', which does not exist: "
                              "correct or unset VK_DRIVER_FILES"),
              std::string::npos)
        << result.err;
}

TEST(BadInput, NoOpenXrRuntime) {
    for (const char* manifest :
         {"/etc/openxr/1/active_runtime.json", "/usr/local/etc/openxr/1/active_runtime.json",
          "/usr/share/openxr/1/openxr_monado.json"}) {
        if (std::filesystem::exists(manifest)) {
            GTEST_SKIP() << "this machine has an OpenXR runtime of its own: " << manifest;
        }
    }
    const ScratchFolder empty;
    const ProgramResult result = run_gazeloop(
        {"run", "--frames", "1"}, {.environment = {{"XR_RUNTIME_JSON", ""},
                                                   {"GAZELOOP_CACHE", empty.file("")},
                                                   {"XDG_CONFIG_DIRS", empty.file("")},
                                                   {"XDG_CONFIG_HOME", empty.file("")}}});
    EXPECT_EQ(result.exit_code, 4) << result.err;
    EXPECT_NE(result.err.find("./dev setup"), std::string::npos) << result.err;
}

TEST(BadInput, AnOpenXrRuntimeThatIsNotThere) {
    const ProgramResult wrong = run_gazeloop(
        {"run", "--frames", "1"}, {.environment = {{"XR_RUNTIME_JSON", "/nowhere/runtime.json"}}});
    EXPECT_EQ(wrong.exit_code, 4) << wrong.err;
    EXPECT_NE(wrong.err.find("/nowhere/runtime.json"), std::string::npos) << wrong.err;
}

TEST(BadInput, JournalsAndScenesThatAreNone) {
    const ScratchFolder folder;
    const std::string csv = folder.write("a.csv", "scene,gaze\nraymarch,0\n");
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"trade", "--merge", csv}, {"trade", "--resume", csv}}) {
        const ProgramResult result = run_gazeloop(words);
        EXPECT_EQ(result.exit_code, 3) << result.err;
        EXPECT_NE(result.err.find(csv + ":1: is no journal of a sweep (it is not as a sweep writes "
                                        "it): name a file that trade --resume wrote"),
                  std::string::npos)
            << result.err;
    }
    const std::string scene = folder.write("a.gltf", "{\n  \"asset\": nothing\n}\n");
    const ProgramResult drawn = run_gazeloop({"run", "--target", "headless", "--frames", "1",
                                              "--set", "render.scale=0.02", "--scene", scene});
    EXPECT_EQ(drawn.exit_code, 3) << drawn.err;
    EXPECT_NE(drawn.err.find("a.gltf: is not JSON: line 2, byte "), std::string::npos) << drawn.err;
    EXPECT_EQ(drawn.err.find("json.exception"), std::string::npos) << drawn.err;
}

TEST(BadInput, SettingsWithoutEffectAreSaid) {
    const std::vector<std::string> run{
        "run",    "--target",  "headless", "--frames",          "1",
        "--gaze", "fixed:0,0", "--set",    "render.scale=0.02", "--quiet"};
    const auto said = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = run;
        words.insert(words.end(), more.begin(), more.end());
        const ProgramResult result = run_gazeloop(words);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return result.err;
    };
    const auto has = [](const std::string& text, const char* part) {
        return text.find(part) != std::string::npos;
    };
    const std::string widened = said({"--set", "gaze.widen_by=events"});
    EXPECT_TRUE(
        has(widened, "gaze.widen_by = events (--set) has no effect with gaze.widen = false"))
        << widened;
    const std::string both =
        said({"--set", "gaze.widen_by=events", "--set", "gaze.widen=true", "--sigma", "2"});
    EXPECT_FALSE(has(both, "has no effect")) << both;
    const std::string other = said({"--method", "full", "--sigma", "2"});
    EXPECT_TRUE(has(other, "kfr.sigma = 2 (--sigma) has no effect with render.method = full"))
        << other;
    const std::string even = said({"--set", "render.post_filter=8"});
    EXPECT_TRUE(has(even,
                    "render.post_filter = 8 (--set): such filters have 3, 5, 7, ... px: taken "
                    "as 7"))
        << even;
    const std::string source = said({"--set", "hid.viewing_distance_m=0.6"});
    EXPECT_TRUE(has(source, "has no effect with --gaze fixed:0,0: it has with --gaze hid"))
        << source;
    const std::string seed = said({"--seed", "3", "--tracker", "fove0"});
    EXPECT_TRUE(has(seed, "sim.seed = 3 (--seed) has no effect with --gaze fixed:0,0")) << seed;
    EXPECT_TRUE(has(seed, "profile.tracker = fove0 (--tracker) has no effect with")) << seed;
    EXPECT_FALSE(has(seed, "sim.delay_ms")) << "nobody asked for that: " << seed;
}

TEST(BadInput, ARunThatRendersNothing) {
    const ProgramResult result = run_gazeloop({"run", "--target", "headless", "--gaze", "fixed:0,0",
                                               "--frames", "0", "--set", "render.scale=0.02"});
    EXPECT_EQ(result.exit_code, 1) << result.err;
    EXPECT_NE(result.err.find("nothing was rendered: ask for more --frames or --seconds"),
              std::string::npos)
        << result.err;
}

TEST(BadInput, ALiveSourceThatGivesNoSampleAtAll) {
    for (const auto& [gaze, remedy] : std::vector<std::pair<std::string, std::string>>{
             {"hid", "plug an eye tracker in"},
             {"psvr2", "plug the PlayStation VR2 in by USB"},
             {"osc:47293", "have its sender (VRCFaceTracking, say) send to this machine"},
             {"steam-frame:/nowhere/gaze", "devices --set steam_frame.file=/nowhere/gaze says"}}) {
        const ProgramResult result =
            run_gazeloop({"run", "--target", "headless", "--gaze", gaze, "--seconds", "0.5",
                          "--set", "render.scale=0.02"});
        EXPECT_EQ(result.exit_code, 4) << gaze << result.err;
        EXPECT_NE(result.err.find("no gaze came"), std::string::npos) << gaze << result.err;
        EXPECT_NE(result.err.find(remedy), std::string::npos) << gaze << result.err;
    }
}

TEST(BadInput, RecordingThatExists) {
    const ScratchFolder folder;
    const std::string file = folder.write("session.gaze", "precious");
    const ProgramResult result = run_gazeloop({"run", "--target", "headless", "--frames", "1",
                                               "--record", file, "--set", "render.scale=0.02"});
    EXPECT_EQ(result.exit_code, 3) << result.err;
    EXPECT_NE(result.err.find(file), std::string::npos) << result.err;
}

TEST(BadInput, StdoutThatTakesNothing) {
    // Long enough to overflow what stdio holds back, and short enough not to.
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"run", "--print-config"},
          {"run", "--help"},
          {"plan", "--json"},
          {"--version"}}) {
        const ProgramResult result =
            run_gazeloop(arguments, {.wrapper = {"sh", "-c", R"(exec "$0" "$@" >/dev/full)"}});
        EXPECT_EQ(result.exit_code, 3) << arguments.front() << ": " << result.err;
        EXPECT_NE(result.err.find("stdout: cannot be written"), std::string::npos) << result.err;
    }
}

TEST(BadInput, StdoutWhoseReaderHasGone) {
    // Its reader has ended when it begins. As other programs do, it ends by SIGPIPE (128 + 13),
    // without a word, whether the text overflows what stdio holds back or not.
    const ScratchFolder folder;
    const auto unread = [](const std::vector<std::string>& arguments) {
        return run_gazeloop(
            arguments,
            {.wrapper = {"sh", "-c", R"({ sleep 0.3; "$0" "$@"; echo "code $?" >&2; } | true)"}});
    };
    const std::string json = folder.file("plan.json");
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"run", "--print-config"},
          {"run", "--help"},
          {"--version"},
          {"plan", "--json"},
          {"plan", "--method", "all", "--json", json}}) {
        EXPECT_EQ(unread(arguments).err, "code 141\n") << arguments.front();
    }
    EXPECT_TRUE(std::filesystem::exists(json)) << "other results are written nevertheless";
    // What a command found stays its code.
    const ProgramResult failed = unread({"run", "--target", "headless", "--frames", "0", "--set",
                                         "render.scale=0.02", "--json", "-"});
    EXPECT_NE(failed.err.find("code 1\n"), std::string::npos) << failed.err;
    EXPECT_EQ(failed.err.find("stdout"), std::string::npos) << failed.err;
}

TEST(BadInput, PrintConfigSaysWhereValuesComeFrom) {
    const ScratchFolder folder;
    const std::string file = folder.write("a.toml", "kfr.sigma = 2.5\n");
    const ProgramResult result = run_gazeloop(
        {"run", "--config", file, "--alpha", "3", "--set", "gaze.hold_ms=10", "--print-config"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.out.find(file + ":1"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("--alpha"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("built-in"), std::string::npos) << result.out;
}

}  // namespace
}  // namespace gazeloop::tests
