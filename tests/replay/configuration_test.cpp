// The layers of the configuration, as users meet them: DESIGN's order, refusals, and the locale.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <tuple>

#include "tests/support/comma_locale.h"
#include "tests/support/nobody.h"
#include "tests/support/preload.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

class Configuration : public testing::Test {
  protected:
    /// Writes the file that $XDG_CONFIG_HOME (below) names.
    void write_users(const std::string& text) const {
        std::filesystem::create_directories(home("gazeloop"));
        std::ofstream(home("gazeloop/config.toml")) << text;
    }
    [[nodiscard]] std::string home(const std::string& name) const {
        return folder_.file("home/" + name);
    }

    [[nodiscard]] ProgramResult print(std::vector<std::string> arguments,
                                      ProgramOptions options = {}) const {
        arguments.insert(arguments.begin(), {"run", "--print-config"});
        if (options.environment.empty()) {
            options.environment = {{"XDG_CONFIG_HOME", folder_.file("home")}};
        }
        return run_gazeloop(arguments, options);
    }

    /// The line of a key in what --print-config printed.
    static std::string line_of(const ProgramResult& result, const std::string& key) {
        const std::string lines = "\n" + result.out;  // other rows may name it too
        const std::size_t begin = lines.find("\n" + key + " ");
        EXPECT_NE(begin, std::string::npos) << result.out << result.err;
        return begin == std::string::npos
                   ? ""
                   : lines.substr(begin + 1, lines.find('\n', begin + 1) - begin - 1);
    }
    static bool has(const std::string& text, const std::string& part) {
        return text.find(part) != std::string::npos;
    }

    ScratchFolder folder_;
};

/// Replaces /etc in a mount namespace, if this machine lets us.
std::vector<std::string> with_etc(const std::string& etc) {
    return {"unshare", "--map-root-user",
            "--mount", "sh",
            "-c",      "mount --bind '" + etc + "' /etc && exec \"$@\"",
            "sh"};
}
/// Why it does not let us, in the words of whoever forbids it; empty: it does.
std::string cannot_replace_etc() {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> tried(
        popen("unshare --map-root-user --mount sh -c 'mount --bind /tmp /etc' 2>&1 || "
              "echo \"exit code $?\"",
              "r"),
        pclose);
    std::string said;
    for (int c = tried ? std::fgetc(tried.get()) : EOF; c != EOF; c = std::fgetc(tried.get())) {
        said += c == '\n' ? ' ' : static_cast<char>(c);
    }
    return said;
}

TEST_F(Configuration, LaterLayersWin) {
    if (const std::string why = cannot_replace_etc(); !why.empty()) {
        GTEST_SKIP() << "/etc cannot be replaced in a mount namespace here: " << why;
    }
    const std::string etc = folder_.file("etc");
    std::filesystem::create_directories(etc + "/gazeloop");
    const auto layer = [](int values) {
        // The n-th layer sets the last n of five keys.
        static constexpr const char* kKeys[] = {"gaze.stale_ms", "gaze.hold_ms", "gaze.return_ms",
                                                "kfr.border_px", "kfr.sigma"};
        std::string text;
        for (int i = values; i < 5; ++i) {
            text += std::string(kKeys[i]) + " = " + std::to_string(values + 1) + ".5\n";
        }
        return text;
    };
    std::ofstream(etc + "/gazeloop/config.toml") << layer(0);
    write_users(layer(1));
    const std::string file = folder_.write("a.toml", layer(2));
    const ProgramResult result = print(
        {"--config", file, "--set", "kfr.border_px=4.5", "--set", "kfr.sigma=4.5", "--sigma",
         "5.5"},
        {.environment = {{"XDG_CONFIG_HOME", folder_.file("home")}}, .wrapper = with_etc(etc)});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(has(line_of(result, "gaze.stale_ms"), "= 1.5"));
    EXPECT_TRUE(has(line_of(result, "gaze.stale_ms"), "# /etc/gazeloop/config.toml:1 "));
    EXPECT_TRUE(has(line_of(result, "gaze.hold_ms"), "= 2.5"));
    EXPECT_TRUE(has(line_of(result, "gaze.hold_ms"), "# " + home("gazeloop/config.toml") + ":1 "));
    EXPECT_TRUE(has(line_of(result, "gaze.return_ms"), "= 3.5"));
    EXPECT_TRUE(has(line_of(result, "gaze.return_ms"), "# " + file + ":1 "));
    EXPECT_TRUE(has(line_of(result, "kfr.border_px"), "= 4.5"));
    EXPECT_TRUE(has(line_of(result, "kfr.border_px"), "# --set "));
    EXPECT_TRUE(has(line_of(result, "kfr.sigma"), "= 5.5"));
    EXPECT_TRUE(has(line_of(result, "kfr.sigma"), "# --sigma "));
    EXPECT_TRUE(has(line_of(result, "kfr.alpha"), "# built-in "));
    // A mistake in the system's file is not skipped over either.
    std::ofstream(etc + "/gazeloop/config.toml") << "\n\nkfr.sigmo = 1\n";
    const ProgramResult mistaken = print({}, {.wrapper = with_etc(etc)});
    EXPECT_EQ(mistaken.exit_code, 2);
    EXPECT_TRUE(has(mistaken.err,
                    "/etc/gazeloop/config.toml:3: unknown key 'kfr.sigmo'; did you "
                    "mean 'kfr.sigma'?"))
        << mistaken.err;
}

TEST_F(Configuration, TheLastOfTwoFilesAndOfTwoAssignmentsCounts) {
    const std::string a = folder_.write("a.toml", "kfr.sigma = 2\nkfr.alpha = 2\n");
    const std::string b = folder_.write("b.toml", "[kfr]\nsigma = 3\n");
    const ProgramResult result =
        print({"--set", "gaze.hold_ms=1", "--config", a, "--config", b, "--set", "gaze.hold_ms=2"});
    EXPECT_TRUE(has(line_of(result, "kfr.sigma"), "= 3 "));
    EXPECT_TRUE(has(line_of(result, "kfr.alpha"), "= 2 "));
    EXPECT_TRUE(has(line_of(result, "gaze.hold_ms"), "= 2 "));
}

TEST_F(Configuration, WhatIsPrintedIsAConfigurationAgain) {
    const ProgramResult first = print(
        {"--sigma", "2.25", "--set", "vulkan.device=a \"b\" \\ c # d", "--set", "kfr.disc=false"});
    ASSERT_EQ(first.exit_code, 0) << first.err;
    const ProgramResult second = print({"--config", folder_.write("printed.toml", first.out)});
    ASSERT_EQ(second.exit_code, 0) << second.err;
    for (const char* key : {"kfr.sigma", "vulkan.device", "kfr.disc", "profile.display"}) {
        const auto value = [&](const ProgramResult& result) {
            const std::string line = line_of(result, key);
            return line.substr(0, line.rfind(" # "));
        };
        EXPECT_EQ(value(first), value(second));
    }
}

TEST_F(Configuration, TheUsersFolderIsFoundByTheRules) {
    write_users("kfr.sigma = 7\n");
    std::filesystem::create_directories(folder_.file("h/.config"));
    std::filesystem::rename(home("gazeloop"), folder_.file("h/.config/gazeloop"));
    // Unset, empty and relative mean $HOME/.config.
    for (const char* config : {"", "relative/path", "."}) {
        const ProgramResult result =
            print({}, {.environment = {{"XDG_CONFIG_HOME", config}, {"HOME", folder_.file("h")}}});
        EXPECT_TRUE(has(line_of(result, "kfr.sigma"), "= 7 ")) << config;
    }
    const ProgramResult empty =
        print({}, {.wrapper = {"env", "XDG_CONFIG_HOME=", "HOME=" + folder_.file("h")}});
    EXPECT_TRUE(has(line_of(empty, "kfr.sigma"), "= 7 "));
    const ProgramResult homeless =
        print({}, {.environment = {{"XDG_CONFIG_HOME", ""}, {"HOME", ""}}});
    EXPECT_EQ(homeless.exit_code, 0) << homeless.err;
}

TEST_F(Configuration, AFileThatCannotBeReadIsSaid) {
    // A folder in the file's place.
    std::filesystem::create_directories(home("gazeloop/config.toml"));
    const ProgramResult folder = print({});
    EXPECT_EQ(folder.exit_code, 3);
    EXPECT_TRUE(has(folder.err, home("gazeloop/config.toml"))) << folder.err;
    EXPECT_TRUE(has(folder.err, "it is a folder")) << folder.err;
    // A link to nowhere.
    std::filesystem::remove(home("gazeloop/config.toml"));
    std::filesystem::create_symlink("/nowhere", home("gazeloop/config.toml"));
    const ProgramResult dangling = print({});
    EXPECT_EQ(dangling.exit_code, 3);
    EXPECT_TRUE(has(dangling.err, "No such file")) << dangling.err;
}

// Root may read everything, so as another user.
TEST_F(Configuration, AFileThatMayNotBeReadIsSaid) {
    write_users("kfr.sigma = 2\n");
    for (const bool hide_folder : {false, true}) {
        const std::string hidden = home(hide_folder ? "gazeloop" : "gazeloop/config.toml");
        chmod(hidden.c_str(), 0);
        for (const std::string& passed : {folder_.file(""), folder_.file("home")}) {
            chmod(passed.c_str(), 0755);
        }
        ProgramOptions options{.environment = {{"XDG_CONFIG_HOME", folder_.file("home")}}};
        if (geteuid() == 0) {
            if (const std::string missing = missing_for_nobody(); !missing.empty()) {
                GTEST_SKIP() << missing;
            }
            options.wrapper = {"setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"};
            if (std::system("setpriv --reuid=65534 --regid=65534 --clear-groups "
                            "test -x '" GAZELOOP_BINARY_DIR "/gazeloop'") != 0) {
                GTEST_SKIP() << "another user than root cannot reach " GAZELOOP_BINARY_DIR
                                ": build in a folder that others may enter";
            }
        }
        const ProgramResult forbidden = print({}, options);
        EXPECT_EQ(forbidden.exit_code, 3) << forbidden.out << forbidden.err;
        EXPECT_TRUE(has(forbidden.err, "Permission denied")) << forbidden.err;
        chmod(hidden.c_str(), 0755);
    }
}

struct BadText {
    const char* name;
    const char* text;
    int exit_code;
    const char* message;  ///< after the file's name
};
void PrintTo(const BadText& at, std::ostream* out) { *out << at.name; }

class BadConfiguration : public testing::TestWithParam<BadText> {};

TEST_P(BadConfiguration, IsRefusedWithItsLine) {
    const ScratchFolder folder;
    const std::string file = folder.write("bad.toml", GetParam().text);
    const ProgramResult result = run_gazeloop({"run", "--print-config", "--config", file});
    EXPECT_EQ(result.exit_code, GetParam().exit_code) << result.err;
    EXPECT_NE(result.err.find(file + GetParam().message), std::string::npos) << result.err;
    EXPECT_EQ(result.out, "");
}

INSTANTIATE_TEST_SUITE_P(
    Configuration, BadConfiguration,
    testing::Values(
        BadText{"syntax", "\n[kfr\n", 3, ":2:"}, BadText{"not_utf8", "a = \"\xff\"\n", 3, ":1:"},
        BadText{"twice", "kfr.sigma = 2\nkfr.sigma = 3\n", 3, ":2:"},
        BadText{"huge_whole", "render.spp = 99999999999999999999\n", 3, ":1:"},
        BadText{"unknown_key", "[kfr]\n\nsgima = 2\n", 2,
                ":3: unknown key 'kfr.sgima'; did you mean 'kfr.sigma'?"},
        BadText{"unknown_group", "[rendre]\nspp = 2\n", 2,
                ":2: unknown key 'rendre.spp'; did you mean 'render.spp'?"},
        BadText{"unknown_empty_group", "\n[rendre]\n", 2, ":2: unknown key 'rendre'"},
        BadText{"group_as_value", "kfr = 3\n", 2, ":1: unknown key 'kfr'"},
        BadText{"value_as_group", "[kfr.sigma]\nx = 1\n", 2, ":2: unknown key 'kfr.sigma.x'"},
        BadText{"text_for_number", "kfr.sigma = \"2\"\n", 2,
                ":1: kfr.sigma: a number is expected, this is a text"},
        BadText{"flag_for_number", "kfr.sigma = true\n", 2, ":1: kfr.sigma: a number is expected"},
        BadText{"fraction_for_whole", "render.spp = 2.0\n", 2,
                ":1: render.spp: a whole number is expected, this is a number"},
        BadText{"text_for_flag", "kfr.disc = \"true\"\n", 2,
                ":1: kfr.disc: true or false is expected, this is a text"},
        BadText{"number_for_flag", "kfr.disc = 1\n", 2, ":1: kfr.disc: true or false is expected"},
        BadText{"number_for_text", "profile.display = 5\n", 2,
                ":1: profile.display: a text in quotes is expected, this is a whole number"},
        BadText{"list", "kfr.sigma = [2]\n", 2, ":1: kfr.sigma: one value is expected"},
        BadText{"list_of_tables", "[[kfr]]\nsigma = 2\n", 2, ":1: kfr: one value is expected"},
        BadText{"date", "kfr.sigma = 2020-01-01\n", 2, ":1: kfr.sigma: one value is expected"},
        BadText{"infinite", "kfr.sigma = inf\n", 2, ":1: kfr.sigma = inf: must lie in [0.5, 32]"},
        BadText{"minus_infinite", "gaze.hold_ms = -inf\n", 2, ":1: gaze.hold_ms = -inf: must lie"},
        BadText{"no_number", "kfr.sigma = nan\n", 2, ":1: kfr.sigma = nan: must lie in"},
        BadText{"too_large", "kfr.sigma = 32.000001\n", 2, ":1: kfr.sigma = 32.000001: must lie"},
        BadText{"negative", "gaze.hold_ms = -1e-300\n", 2, ":1: gaze.hold_ms = -1e-300: must lie"},
        BadText{"unknown_name", "render.method = \"kfrr\"\n", 2,
                ":1: unknown method 'kfrr'; did you mean 'kfr'?"},
        // The first mistake in the file is the one that is named.
        BadText{"two_mistakes", "[render]\nspp = 0\n[gaze]\nhold_ms = -1\n", 2, ":2: render.spp"}),
    [](const auto& instance) { return instance.param.name; });

TEST_F(Configuration, AssignmentsAreCheckedToo) {
    const std::pair<const char*, const char*> refusals[] = {
        {"kfr.sigma=1e400", "too large or too small"},
        {"kfr.sigma=inf", "must lie in [0.5, 32]"},
        {"kfr.sigma=-nan", "must lie in"},
        {"kfr.sigma=", "not a number"},
        {"kfr.sigma= 2", "not a number"},
        {"kfr.sigma=2,5", "not a number"},
        {"kfr.sigma=2x", "not a number"},
        {"render.spp=2.0", "not a whole number"},
        {"render.spp=99999999999999999999", "too large or too small"},
        {"=3", "unknown key ''"},
    };
    for (const auto& [assignment, message] : refusals) {
        const ProgramResult result = print({"--set", assignment});
        EXPECT_EQ(result.exit_code, 2) << assignment;
        EXPECT_TRUE(has(result.err, message)) << assignment << ": " << result.err;
    }
}

// What a value names is looked for only when it is needed; the message still says where it stands.
TEST_F(Configuration, WhatAValueNamesIsMissedAtItsLine) {
    const std::tuple<const char*, int, const char*> refusals[] = {
        {"\nprofile.display = \"fove1\"\n", 2, ":2: profile.display: unknown display 'fove1'"},
        {"[profile]\ntracker = \"nobody\"\n", 2, ":2: profile.tracker: unknown tracker 'nobody'"},
        {"profile.display = \"none.toml\"\n", 3, ":1: profile.display: "},
        {"kfr.kernel = \"table\"\nkfr.kernel_table = \"none.csv\"\n", 3, ":2: kfr.kernel_table: "},
        {"kfr.kernel = \"table\"\n", 2, ":1: kfr.kernel: the table's file is missing"},
        {"kfr.kernel = \"polynomial\"\nkfr.polynomial = \"1,x\"\n", 2, ":2: kfr.polynomial: '1,x'"},
        {"kfr.kernel = \"polynomial\"\nkfr.polynomial = [-1]\n", 2, ":2: kfr.polynomial: '-1'"},
        {"target.name = \"headless\"\nvulkan.device = \"Voodoo\"\n", 4,
         ":2: vulkan.device = 'Voodoo'"},
        {"vulkan.device = \"Voodoo\"\n", 2, ":1: vulkan.device: over OpenXR the runtime chooses"},
    };
    for (const auto& [text, code, message] : refusals) {
        const std::string file = folder_.write("a.toml", text);
        const ProgramResult result =
            run_gazeloop({"run", "--frames", "1", "--config", file},
                         {.environment = {{"XDG_CONFIG_HOME", folder_.file("home")}}});
        EXPECT_EQ(result.exit_code, code) << result.err;
        EXPECT_TRUE(has(result.err, file + message)) << result.err;
    }
}

TEST_F(Configuration, PathsInAFileStartAtItsFolder) {
    std::filesystem::create_directories(home("gazeloop/mine"));
    std::filesystem::copy_file(GAZELOOP_SOURCE_DIR "/config/displays/vive_pro_eye.toml",
                               home("gazeloop/mine/display.toml"));
    std::filesystem::copy_file(GAZELOOP_SOURCE_DIR "/config/trackers/vive_pro_eye.toml",
                               home("gazeloop/tracker.toml"));
    std::ofstream(home("gazeloop/kernel.csv")) << "0,0\n0.5,0.25\n1,1\n";
    write_users(
        "kfr.kernel = \"table\"\nkfr.kernel_table = \"kernel.csv\"\n"
        "profile.display = \"mine/display.toml\"\nprofile.tracker = \"tracker.toml\"\n");
    const ProgramResult result = print({});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    // In full: what is printed is a configuration again, wherever it is put.
    const std::string display = home("gazeloop/mine/display.toml");
    EXPECT_TRUE(has(line_of(result, "profile.display"), "'" + display + "'")) << result.out;
    EXPECT_TRUE(has(line_of(result, "sim.delay_ms"), "= 50 ")) << result.out;
    EXPECT_TRUE(has(line_of(result, "kfr.kernel_samples"), "0.5,0.25")) << result.out;
    const ProgramResult run =
        run_gazeloop({"run", "--target", "headless", "--frames", "2", "--set", "render.scale=0.02"},
                     {.environment = {{"XDG_CONFIG_HOME", folder_.file("home")}}});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    // On the command line a path starts where the person is; a name stays a name.
    const ProgramResult named = print({"--display", "psvr2", "--tracker", "./none.toml"});
    EXPECT_EQ(named.exit_code, 3);
    EXPECT_TRUE(has(named.err, "--tracker: profile.tracker: ./none.toml: ")) << named.err;
    EXPECT_TRUE(has(line_of(print({"--display", "psvr2"}), "profile.display"), "'psvr2'"));
}

// A library that sets the user's locale must not change a digit of what is read or written.
TEST_F(Configuration, NumbersKeepTheirPointsUnderACommaLocale) {
    const auto locale = make_comma_locale(folder_.file(""));
    ASSERT_TRUE(locale)
        << "no locale with a decimal comma can be made: ./dev test installs locales";
    const std::string trace = folder_.file("gaze.csv");
    const std::string config = folder_.write("c.toml", "kfr.sigma = 2.25\n");
    // Without the passes' times nothing is measured in virtual time: every run is the same.
    const auto run_all = [&](const ProgramOptions& options) {
        const std::string session = folder_.file("session.gaze");
        std::filesystem::remove(session);
        std::string all;
        const auto add = [&](const std::vector<std::string>& arguments) {
            const ProgramResult result = run_gazeloop(arguments, options);
            EXPECT_EQ(result.exit_code, 0) << result.err;
            all += result.out;
        };
        add({"simulate", "gaze", trace, "--seconds", "0.5", "--rate", "100.5"});
        std::ifstream file(trace);
        all.append(std::istreambuf_iterator<char>(file), {});
        add({"run", "--print-config", "--config", config, "--set", "gaze.hold_ms=1.5"});
        add({"replay", trace, "--seconds", "0.1", "--hash", "--set", "render.scale=0.05", "--set",
             "render.profile=false", "--speed", "1.5", "--config", config, "--record", session});
        add({"report", session, "--json", "-"});
        add({"report", session});
        return all;
    };
    const std::string plain = run_all({});
    EXPECT_NE(plain.find("2.25"), std::string::npos);
    EXPECT_NE(plain.find("hash pixels"), std::string::npos);
    Environment commas = preloaded(GAZELOOP_COMMA_LOCALE);
    commas.insert(commas.end(), {{"LOCPATH", locale->folder},
                                 {"GAZELOOP_TEST_LOCALE", locale->name},
                                 {"LC_ALL", locale->name}});
    EXPECT_EQ(run_all({.environment = commas}), plain);
}

}  // namespace
}  // namespace gazeloop::tests
