// Where results are written: nothing that is recorded or read is lost by it, whatever the command.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/background_process.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

using testing::HasSubstr;

using Words = std::vector<std::string>;

std::string bytes_of(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// What only reads and computes has nothing to close: a trace that never ends is no reason to stay.
TEST(Interrupted, EndsAtOnceWhatMakesResults) {
    const ScratchFolder folder;
    const std::string pipe = folder.file("gaze.csv");
    const std::string out = folder.write("out.csv", "before");
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    for (const Words& words :
         {Words{"convert", pipe, out}, Words{"gaze", pipe}, Words{"replay", pipe}}) {
        for (const int signal : {SIGINT, SIGTERM}) {
            Words command{GAZELOOP_BINARY_DIR "/gazeloop"};
            command.insert(command.end(), words.begin(), words.end());
            BackgroundProcess program(
                {.command = command, .environment = {}, .output_file = folder.file("said")});
            std::ofstream rows(pipe);  // opens once it is read
            rows << "time_s,left_azimuth_deg,left_elevation_deg\n0,1,2\n" << std::flush;
            program.signal(signal);
            EXPECT_EQ(program.wait(std::chrono::seconds(20)), 130) << words[0] << program.output();
            EXPECT_THAT(program.output(), HasSubstr("interrupted"));
        }
    }
    EXPECT_EQ(bytes_of(out), "before");
    // Nor is a result that takes long to make.
    BackgroundProcess program({.command = {GAZELOOP_BINARY_DIR "/gazeloop", "simulate", "gaze", out,
                                           "--seconds", "10000"},
                               .environment = {},
                               .output_file = folder.file("said")});
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    program.signal(SIGINT);
    EXPECT_EQ(program.wait(std::chrono::seconds(20)), 130) << program.output();
    EXPECT_EQ(bytes_of(out), "before");
}

class OutputFiles : public testing::Test {
  protected:
    void SetUp() override {
        ASSERT_EQ(run_gazeloop({"simulate", "gaze", trace_, "--seconds", "2"}).exit_code, 0);
        ASSERT_EQ(run_gazeloop({"study", "plan", "f3d-pair", plan_}).exit_code, 0);
    }
    std::string recorded(const std::string& name) {
        const std::string file = folder_.file(name);
        const ProgramResult made = run_gazeloop(
            {"replay", trace_, "--frames", "3", "--set", "render.scale=0.02", "--record", file});
        EXPECT_EQ(made.exit_code, 0) << made.err;
        return file;
    }

    ScratchFolder folder_;
    std::string trace_ = folder_.file("trace.csv");
    std::string plan_ = folder_.file("plan.toml");
};

TEST_F(OutputFiles, ReplaceNoRecording) {
    const std::string one = recorded("one.gaze");
    const std::string other = recorded("other.gaze");
    const std::string before = bytes_of(other);
    ASSERT_FALSE(before.empty());
    for (const Words& words :
         {Words{"convert", trace_, other}, Words{"convert", one, other, "--to", "angles"},
          Words{"plan", "--json", other}, Words{"report", one, "--html", other},
          Words{"report", one, "--perfetto", other}, Words{"gaze", trace_, "--events", other},
          Words{"simulate", "gaze", other}, Words{"study", "simulate", plan_, other},
          Words{"study", "plan", "kfr-pilot", other},
          Words{"study", "power", plan_, "--json", other},
          Words{"numerics", "--quick", "--json", other}, Words{"doctor", "--json", other},
          Words{"run", "--target", "headless", "--frames", "1", "--json", other}}) {
        const ProgramResult result = run_gazeloop(words);
        EXPECT_EQ(result.exit_code, 3) << testing::PrintToString(words) << result.err;
        EXPECT_THAT(result.err, HasSubstr(other)) << testing::PrintToString(words);
        EXPECT_TRUE(bytes_of(other) == before) << testing::PrintToString(words);
    }
    EXPECT_THAT(run_gazeloop({"plan", "--json", other}).err,
                HasSubstr("a recording is there, which cannot be had again: name another file"));
}

TEST_F(OutputFiles, AreNoneOfWhatIsRead) {
    const std::string config = folder_.write("config.toml", "kfr.sigma = 2.5\n");
    const std::string described = folder_.file("t.json");
    std::filesystem::copy(trace_, described);
    std::filesystem::create_directory(folder_.file("frames"));
    const std::string frame = folder_.write("frames/000001.png", "a frame");
    for (const auto& [words, lost] : std::vector<std::pair<Words, std::string>>{
             {{"study", "simulate", plan_, plan_}, plan_},
             {{"study", "power", plan_, "--json", plan_}, plan_},
             {{"study", "analyse", plan_, trace_, "--csv", plan_}, plan_},
             {{"plan", "--config", config, "--json", config}, config},
             {{"simulate", "gaze", config, "--config", config}, config},
             {{"doctor", "--config", config, "--json", config}, config},
             {{"trade", "--config", config, "--csv", config}, config},
             {{"run", "--target", "headless", "--config", config, "--json", config}, config},
             {{"convert", described, folder_.file("t")}, described},
             {{"convert", trace_, folder_.file("u"), "--json", trace_ + ".json"}, trace_ + ".json"},
             {{"probe", "--video", folder_.file("frames"), "--camera-fps", "240", "--lamp",
               "0,0,1,1", "--patch", "2,0,1,1", "--json", frame},
              frame}}) {
        const std::string before = bytes_of(lost);
        const ProgramResult result = run_gazeloop(words);
        EXPECT_EQ(result.exit_code, 2) << testing::PrintToString(words) << result.err;
        EXPECT_THAT(result.err, HasSubstr("it would be lost; name another file"))
            << testing::PrintToString(words);
        EXPECT_TRUE(bytes_of(lost) == before) << testing::PrintToString(words);
    }
}

TEST_F(OutputFiles, OfAStudyGoThroughLinksAndPipes) {
    const std::string target = folder_.write("target.csv", "");
    const std::string link = folder_.file("link.csv");
    std::filesystem::create_symlink(target, link);
    const Words simulate{"study", "simulate", plan_, link, "--subjects", "1"};
    ASSERT_EQ(run_gazeloop(simulate).exit_code, 0);
    EXPECT_TRUE(std::filesystem::is_symlink(link));
    EXPECT_THAT(bytes_of(target), HasSubstr("subject,trial"));

    const std::string pipe = folder_.file("pipe");
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    const int reader = open(pipe.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    ASSERT_GE(reader, 0);
    const ProgramResult piped = run_gazeloop({"study", "simulate", plan_, pipe, "--subjects", "1"});
    EXPECT_EQ(piped.exit_code, 0) << piped.err;
    std::string begin(8, '\0');
    EXPECT_EQ(read(reader, begin.data(), begin.size()), 8);
    EXPECT_EQ(begin, "subject,");
    close(reader);
    EXPECT_TRUE(std::filesystem::is_fifo(pipe));

    // What is forgotten is gone, and not the link to it alone.
    ASSERT_EQ(run_gazeloop({"study", "forget", "1", link}).exit_code, 0);
    EXPECT_TRUE(std::filesystem::is_symlink(link));
    EXPECT_EQ(bytes_of(target).find("\n1,"), std::string::npos);
}

TEST_F(OutputFiles, KeepAPlanThatSomebodyChanged) {
    EXPECT_EQ(run_gazeloop({"study", "plan", "f3d-pair", plan_}).exit_code, 0) << "as it was";
    std::ofstream(plan_, std::ios::app) << "# mine\n";
    const std::string mine = bytes_of(plan_);
    const ProgramResult result = run_gazeloop({"study", "plan", "f3d-pair", plan_});
    EXPECT_EQ(result.exit_code, 3) << result.err;
    EXPECT_THAT(result.err, HasSubstr("which would be lost: name another file, or remove it"));
    EXPECT_EQ(bytes_of(plan_), mine);
}

TEST_F(OutputFiles, AreNotMadeOfASessionOfNoStudy) {
    const ProgramResult result = run_gazeloop({"study", "analyse", plan_, recorded("one.gaze")});
    EXPECT_EQ(result.exit_code, 3) << result.out;
    EXPECT_THAT(result.err, HasSubstr("a session that holds no trials of a study"));
}

}  // namespace
}  // namespace gazeloop::tests
