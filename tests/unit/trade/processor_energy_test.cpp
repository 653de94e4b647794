#include "runtime/trade/processor_energy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace gazeloop::trade {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A folder as Linux shows it.
class ProcessorEnergyTest : public testing::Test {
  protected:
    void zone(const std::string& folder, const std::string& name, std::uint64_t energy_uj,
              std::uint64_t range_uj = 262'143'328'850) {
        fs::create_directories(root() / folder);
        write(folder, "name", name);
        write(folder, "energy_uj", std::to_string(energy_uj));
        write(folder, "max_energy_range_uj", std::to_string(range_uj));
    }
    void write(const std::string& folder, const std::string& file, const std::string& text) {
        std::ofstream(root() / folder / file) << text << '\n';
    }
    [[nodiscard]] fs::path root() const { return folder_.path(); }

  private:
    tests::TemporaryFolder folder_;
};

TEST_F(ProcessorEnergyTest, IsTheSumOfThePackagesAndOfNothingWithinThem) {
    fs::create_directories(root() / "intel-rapl");  // no zone, and without a name
    zone("intel-rapl:0", "package-0", 5'000'000);
    zone("intel-rapl:0:0", "core", 1'000'000);
    zone("intel-rapl:0:1", "dram", 1'000'000);
    zone("intel-rapl:1", "package-1", 7'000'000);
    zone("intel-rapl:2", "psys", 1'000'000);
    ProcessorEnergy energy(root());
    ASSERT_EQ(energy.unavailable(), "");
    EXPECT_EQ(energy.joules(), 0.0);
    zone("intel-rapl:0", "package-0", 6'500'000);
    zone("intel-rapl:0:0", "core", 2'000'000);
    zone("intel-rapl:1", "package-1", 7'250'000);
    zone("intel-rapl:2", "psys", 9'000'000);
    EXPECT_DOUBLE_EQ(energy.joules().value(), 1.75);
    EXPECT_DOUBLE_EQ(energy.joules().value(), 1.75);
}

TEST_F(ProcessorEnergyTest, TakesAPackageThatIsToldOfTwiceOnce) {
    zone("intel-rapl-mmio:0", "package-0", 100);
    zone("intel-rapl:0", "package-0", 200);
    ProcessorEnergy energy(root());
    zone("intel-rapl-mmio:0", "package-0", 50'000'100);
    zone("intel-rapl:0", "package-0", 2'000'200);
    EXPECT_DOUBLE_EQ(energy.joules().value(), 2.0);
}

TEST_F(ProcessorEnergyTest, GoesOnWhereACounterWraps) {
    zone("intel-rapl:0", "package-0", 990'000, 1'000'000);
    ProcessorEnergy energy(root());
    zone("intel-rapl:0", "package-0", 20'000, 1'000'000);
    EXPECT_DOUBLE_EQ(energy.joules().value(), 0.03);
    // Beyond its own range, a counter that falls was set back.
    zone("intel-rapl:0", "package-0", 2'000'000, 1'000'000);
    EXPECT_TRUE(energy.joules());
    zone("intel-rapl:0", "package-0", 1'000, 1'000'000);
    EXPECT_FALSE(energy.joules());
    zone("intel-rapl:0", "package-0", 11'000, 1'000'000);
    EXPECT_DOUBLE_EQ(energy.joules().value(), 0.03 + 1.98 + 0.01);
}

TEST_F(ProcessorEnergyTest, SaysWhyThereIsNone) {
    EXPECT_THAT(ProcessorEnergy(root() / "none").unavailable(), HasSubstr("none has no counters"));
    EXPECT_THAT(ProcessorEnergy(root()).unavailable(), HasSubstr("a virtual machine"));
    zone("intel-rapl:0", "package-0", 0);
    write("intel-rapl:0", "energy_uj", "much");
    ProcessorEnergy energy(root());
    EXPECT_THAT(energy.unavailable(), HasSubstr("intel-rapl:0/energy_uj: holds no number"));
    EXPECT_FALSE(energy.joules());
    fs::remove(root() / "intel-rapl:0" / "energy_uj");
    EXPECT_THAT(ProcessorEnergy(root()).unavailable(), HasSubstr("No such file"));
}

TEST_F(ProcessorEnergyTest, IsUnknownOnceACounterIsGone) {
    zone("intel-rapl:0", "package-0", 10);
    ProcessorEnergy energy(root());
    fs::remove(root() / "intel-rapl:0" / "energy_uj");
    EXPECT_FALSE(energy.joules());
}

}  // namespace
}  // namespace gazeloop::trade
