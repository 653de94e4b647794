// Parts of a scratch file that are read on another thread.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "runtime/memory/read_ahead.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::memory {
namespace {

using State = ReadAhead::State;

constexpr std::size_t kPart = 4096;
constexpr std::uint32_t kParts = 64;

/// A file of parts, each full of its number.
class ReadAheadTest : public testing::Test {
  protected:
    ReadAheadTest() : file_(value_or_throw(ScratchFile::make(folder_.path()))) {
        for (std::uint32_t part = 0; part < kParts; ++part) {
            value_or_throw(file_.write(part * kPart, std::vector(kPart, std::byte(part))));
        }
    }

    tests::TemporaryFolder folder_;
    ScratchFile file_;
};

TEST_F(ReadAheadTest, GivesWhatWasAskedFor) {
    std::vector<std::vector<std::byte>> memory(4, std::vector<std::byte>(kPart));
    ReadAhead thread(file_, 4);
    for (std::uint32_t place = 0; place < 4; ++place) {
        EXPECT_EQ(thread.state(place), State::Free);
        thread.ask(place, (10 + place) * kPart, memory[place]);
    }
    for (const std::uint32_t place : {2U, 0U, 3U, 1U}) {
        EXPECT_TRUE(thread.take(place));
        EXPECT_EQ(thread.state(place), State::Free);
        EXPECT_EQ(memory[place], std::vector(kPart, std::byte(10 + place)));
    }
}

// What lies beyond the end of the file says so where it is taken, and takes nothing from others.
TEST_F(ReadAheadTest, SaysWhatItCouldNotRead) {
    std::vector<std::vector<std::byte>> memory(2, std::vector<std::byte>(kPart));
    ReadAhead thread(file_, 2);
    thread.ask(0, kParts * kPart, memory[0]);
    thread.ask(1, kPart, memory[1]);
    EXPECT_FALSE(thread.take(0));
    EXPECT_TRUE(thread.take(1));
    thread.ask(0, 5 * kPart, memory[0]);
    EXPECT_TRUE(thread.take(0));
    EXPECT_EQ(memory[0], std::vector(kPart, std::byte(5)));
}

// Some are waited for, some taken back, some asked after; what is read is always what was asked
// for, and what was taken back is left alone from then on. (By threads, for ThreadSanitizer.)
TEST_F(ReadAheadTest, HoldsToWhatIsAskedOfItInAnyOrder) {
    constexpr std::uint32_t kPlaces = 6;
    std::mt19937 random(5);
    std::vector<std::vector<std::byte>> memory(kPlaces, std::vector<std::byte>(kPart));
    std::vector<std::uint32_t> part(kPlaces, kParts);  ///< that a place was asked for; none: kParts
    std::size_t taken_back = 0;
    std::size_t read = 0;
    {
        ReadAhead thread(file_, kPlaces);
        for (int turn = 0; turn < 4000; ++turn) {
            const auto place = static_cast<std::uint32_t>(random() % kPlaces);
            if (part[place] == kParts) {
                ASSERT_EQ(thread.state(place), State::Free);
                part[place] = static_cast<std::uint32_t>(random() % kParts);
                thread.ask(place, part[place] * kPart, memory[place]);
                continue;
            }
            if (random() % 2 == 0 && thread.take_back(place)) {
                ++taken_back;
                memory[place].assign(kPart, std::byte{255});  // ours again
            } else if (random() % 2 == 0 || thread.state(place) == State::Read) {
                ++read;
                ASSERT_TRUE(thread.take(place));
                ASSERT_EQ(memory[place], std::vector(kPart, std::byte(part[place])));
            } else {
                continue;
            }
            part[place] = kParts;
        }
        for (std::uint32_t place = 0; place < kPlaces; ++place) {
            if (part[place] == kParts) {
                thread.ask(place, 0, memory[place]);
            }
        }
    }  // ends with parts that nobody takes
    EXPECT_GT(read, 100U);
    EXPECT_GT(taken_back, 0U);
}

TEST_F(ReadAheadTest, TakesBackNothingThatIsDone) {
    std::vector<std::byte> memory(kPart);
    ReadAhead thread(file_, 1);
    EXPECT_FALSE(thread.take_back(0)) << "nothing was asked for";
    thread.ask(0, 0, memory);
    while (thread.state(0) != State::Read) {
        std::this_thread::yield();
    }
    EXPECT_FALSE(thread.take_back(0));
    EXPECT_TRUE(thread.take(0));
}

}  // namespace
}  // namespace gazeloop::memory
