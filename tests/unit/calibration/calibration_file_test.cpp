#include "runtime/calibration/calibration_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "tests/support/temporary_folder.h"

namespace gazeloop::calibration {
namespace {

CalibrationFile example() {
    CalibrationFile file;
    file.user = "some \"one\"\nelse";
    file.device = "simulated tracker";
    file.calibration[0] = {.azimuth = {0.05, -1.0 / 3.0, 0.0, 1.0, -0.2, 1e-17},
                           .elevation = {-0.02, 0.04, 0.1, -0.3, 2.0, 0.2},
                           .reach_rad = 0.31};
    file.expected_error_deg[0] = 0.5;
    return file;
}

class CalibrationFiles : public testing::Test {
  protected:
    std::string refusal(const std::string& text) {
        std::ofstream(path_, std::ios::binary) << text;
        const auto read = read_calibration(path_);
        EXPECT_FALSE(read.has_value()) << text;
        return read ? std::string() : read.error().message;
    }
    std::string written() {
        value_or_throw(write_calibration(example(), path_));
        std::stringstream text;
        text << std::ifstream(path_).rdbuf();
        return text.str();
    }

    tests::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "me.toml";
};

TEST_F(CalibrationFiles, AreReadBackBitForBitAndBelongToTheirOwner) {
    value_or_throw(write_calibration(example(), path_));
    struct stat status{};
    ASSERT_EQ(stat(path_.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0600U);
    const CalibrationFile read = value_or_throw(read_calibration(path_));
    EXPECT_EQ(read.calibration, example().calibration);
    EXPECT_EQ(read.user, "some \"one\" else") << "in one line";
    EXPECT_EQ(read.device, "simulated tracker");
    EXPECT_EQ(read.expected_error_deg[0], 0.5);
    // Again, over itself and over one with wider rights.
    ASSERT_EQ(chmod(path_.c_str(), 0666), 0);
    value_or_throw(write_calibration(example(), path_));
    ASSERT_EQ(stat(path_.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0600U);
}

TEST_F(CalibrationFiles, AreRefusedByNameWhereTheyAreNone) {
    const std::string good = written();
    EXPECT_NE(refusal("").find("is no calibration"), std::string::npos);
    EXPECT_NE(refusal("a = ").find("line 1"), std::string::npos);
    EXPECT_NE(refusal("format = \"gazeloop-calibration\"\nversion = 2\n").find("version = 1"),
              std::string::npos);
    EXPECT_NE(refusal("format = \"gazeloop-calibration\"\nversion = 1\n").find("calibrates no eye"),
              std::string::npos);
    const auto changed = [&good](const std::string& from, const std::string& to) {
        std::string text = good;
        const std::size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        return text.replace(at, from.size(), to);
    };
    EXPECT_NE(refusal(changed("azimuth = [", "azimuth = [1.0, ")).find("[left] needs"),
              std::string::npos);
    EXPECT_NE(refusal(changed("reach_rad = 0.31", "reach_rad = 0.0")).find("[left] needs"),
              std::string::npos);
    EXPECT_NE(refusal(changed("reach_rad = 0.31", "reach_rad = 4.0")).find("out of range"),
              std::string::npos);
    EXPECT_NE(refusal(changed("reach_rad = 0.31", "reach_rad = nan")).find("[left] needs"),
              std::string::npos);
    EXPECT_NE(refusal(changed("0.05", "inf")).find("is none"), std::string::npos);
    EXPECT_NE(refusal(changed("0.05", "\"x\"")).find("[left] needs"), std::string::npos);
    EXPECT_NE(refusal(std::string(70'000, '#')).find("larger"), std::string::npos);
    EXPECT_NE(read_calibration(folder_.path()).error().message.find("it is a folder"),
              std::string::npos);
    EXPECT_EQ(read_calibration(folder_ / "none").error().kind, ErrorKind::BadInput);
}

TEST_F(CalibrationFiles, CutShortAnywhereAreRefused) {
    CalibrationFile both = example();
    both.calibration[1] = both.calibration[0];
    value_or_throw(write_calibration(both, path_));
    std::stringstream text;
    text << std::ifstream(path_).rdbuf();
    const std::string whole = text.str();
    // Every byte of the last table, and some of what is before.
    for (std::size_t size = 0; size < whole.size(); size += size + 250 < whole.size() ? 7 : 1) {
        EXPECT_NE(refusal(whole.substr(0, size)), "") << size;
    }
    EXPECT_NE(refusal(whole.substr(0, whole.size() - 3)).find("is cut short"), std::string::npos);
    EXPECT_NE(refusal(whole.substr(0, whole.find("[right]"))).find("lacks [right]"),
              std::string::npos);
}

TEST_F(CalibrationFiles, ThatCannotBeWrittenSayWhy) {
    const auto failed = write_calibration(example(), folder_ / "no" / "folder.toml");
    ASSERT_FALSE(failed.has_value());
    EXPECT_NE(failed.error().message.find("No such file or directory"), std::string::npos);
    EXPECT_EQ(failed.error().kind, ErrorKind::BadInput);
}

}  // namespace
}  // namespace gazeloop::calibration
