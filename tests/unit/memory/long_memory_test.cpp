#include "runtime/memory/long_memory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <string>
#include <thread>

#include "runtime/environment.h"
#include "runtime/error.h"
#include "runtime/memory/long_vector.h"
#include "runtime/memory/scratch_file.h"
#include "runtime/memory/spool.h"

namespace gazeloop::memory {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::size_t kLong = 4 * kLongBlock / sizeof(std::uint64_t);

LongVector<std::uint64_t> counted(std::size_t count) {
    LongVector<std::uint64_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), std::uint64_t{7});
    return numbers;
}

bool counts_on(const LongVector<std::uint64_t>& numbers) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (numbers[i] != i + 7) {
            return false;
        }
    }
    return true;
}

/// What TMPDIR says meanwhile.
class ScratchIn {
  public:
    explicit ScratchIn(const std::string& folder) : before_(environment_value("TMPDIR")) {
        setenv("TMPDIR", folder.c_str(), 1);
    }
    ScratchIn(const ScratchIn&) = delete;
    ScratchIn& operator=(const ScratchIn&) = delete;
    ~ScratchIn() {
        if (before_) {
            setenv("TMPDIR", before_->c_str(), 1);
        } else {
            unsetenv("TMPDIR");
        }
    }

  private:
    std::optional<std::string> before_;
};

TEST(LongVector, StaysInMemoryWithoutALimit) {
    const LongBlocks before = long_blocks();
    const auto numbers = counted(kLong);
    EXPECT_EQ(long_blocks().in_memory, before.in_memory + kLong * sizeof(std::uint64_t));
    EXPECT_EQ(long_blocks().in_files, before.in_files);
    EXPECT_TRUE(counts_on(numbers));
}

TEST(LongVector, LiesInAFileBeyondTheLimitAndHoldsWhatWasWritten) {
    const LongBlocks before = long_blocks();
    {
        const MemoryLimit limit(before.in_memory + kLong * sizeof(std::uint64_t));
        const auto first = counted(kLong);
        auto second = counted(kLong);
        EXPECT_EQ(long_blocks().in_memory, before.in_memory + kLong * sizeof(std::uint64_t));
        EXPECT_EQ(long_blocks().in_files, before.in_files + kLong * sizeof(std::uint64_t));
        // Long enough for pages to be let go of, again and again.
        for (int i = 0; i < 10; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            EXPECT_TRUE(counts_on(first));
            EXPECT_TRUE(counts_on(second));
        }
        for (std::size_t i = second.size(); i < 3 * kLong; ++i) {
            second.push_back(i + 7);
        }
        EXPECT_TRUE(counts_on(second)) << "moved as it grew";
    }
    EXPECT_EQ(long_blocks().in_memory, before.in_memory);
    EXPECT_EQ(long_blocks().in_files, before.in_files);
}

TEST(LongVector, OutlivesTheLimit) {
    LongVector<std::uint64_t> numbers;
    {
        const MemoryLimit limit(0);
        numbers = counted(kLong);
        EXPECT_GT(long_blocks().in_files, 0U);
    }
    EXPECT_TRUE(counts_on(numbers));
}

TEST(MemoryLimit, SaysWhereNoScratchFileCanBe) {
    const ScratchIn nowhere("/nonexistent/folder");
    const MemoryLimit limit(0);
    try {
        const auto numbers = counted(kLong);
        FAIL() << "there is no such folder";
    } catch (const SetupError& error) {
        EXPECT_EQ(error.kind(), ErrorKind::BadInput);
        EXPECT_THAT(error.what(), AllOf(HasSubstr("/nonexistent/folder: no scratch file"),
                                        HasSubstr("let TMPDIR name a folder")));
    }
}

TEST(MemoryLimit, DoubtsAFolderInMemory) {
    if (const auto file = ScratchFile::make("/dev/shm"); !file || file->in_memory().empty()) {
        GTEST_SKIP() << "/dev/shm is no file system in memory here";
    }
    const ScratchIn memory("/dev/shm");
    const MemoryLimit limit(0);
    EXPECT_EQ(limit.doubt(), "");
    const auto numbers = counted(kLong);
    EXPECT_THAT(limit.doubt(), HasSubstr("/dev/shm: is kept in memory itself"));
}

class Spooled : public testing::TestWithParam<std::size_t> {};

TEST_P(Spooled, IsReadFromAnyPlace) {
    const MemoryLimit limit(0);
    const std::size_t count = GetParam();
    Spool<std::uint64_t> spool;
    for (std::size_t i = 0; i < count; ++i) {
        spool.add(i + 7);
    }
    ASSERT_EQ(spool.size(), count);
    for (const std::size_t length : {std::size_t{1}, std::size_t{100}, count}) {
        LongVector<std::uint64_t> read(length);
        for (std::size_t first = 0; first + length <= count; first += 1 + length / 3) {
            spool.read(first, read);
            for (std::size_t i = 0; i < length; ++i) {
                ASSERT_EQ(read[i], first + i + 7) << first;
            }
        }
    }
    SpoolReader<std::uint64_t> reader(spool);
    for (std::size_t i = 0; i < count; i += 3) {
        const std::uint64_t& one = reader[i];
        const std::uint64_t& other = reader[count - 1 - i];
        ASSERT_EQ(one, i + 7);
        ASSERT_EQ(other, count - 1 - i + 7);
    }
}

INSTANTIATE_TEST_SUITE_P(Of, Spooled,
                         testing::Values(100U, Spool<std::uint64_t>::kBuffered,
                                         Spool<std::uint64_t>::kBuffered + 1,
                                         5 * Spool<std::uint64_t>::kBuffered + 17));

TEST(Spooled, StaysInMemoryWhereNoLimitIs) {
    const ScratchIn nowhere("/nonexistent/folder");
    Spool<std::uint64_t> spool;
    for (std::size_t i = 0; i < 3 * Spool<std::uint64_t>::kBuffered; ++i) {
        spool.add(i);
    }
    std::uint64_t last = 0;
    spool.read(spool.size() - 1, {&last, 1});
    EXPECT_EQ(last, spool.size() - 1);
    const MemoryLimit limit(0);
    Spool<std::uint64_t> refused;
    EXPECT_THROW(
        {
            for (std::size_t i = 0; i < 2 * Spool<std::uint64_t>::kBuffered; ++i) {
                refused.add(i);
            }
        },
        SetupError);
}

}  // namespace
}  // namespace gazeloop::memory
