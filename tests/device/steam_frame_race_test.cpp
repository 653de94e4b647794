// Samples that another process writes while they are read: whole, or not taken.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstring>

#include "drivers/steam_frame/shared_file.h"
#include "runtime/time/clock.h"
#include "sim/steam_frame_file.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::drivers::steam_frame {
namespace {

/// All bytes of a record follow from its counter.
sim::SteamFrameRecord record_of(std::uint32_t counter) {
    sim::SteamFrameRecord record{};
    std::uint32_t state = counter * 2654435761U + 1;
    for (std::uint8_t& byte : record) {
        state = state * 1664525U + 1013904223U;
        byte = static_cast<std::uint8_t>(state >> 24U);
    }
    return record;
}

/// Shared with the writer.
struct Told {
    std::atomic<bool> stop{false};
    std::atomic<std::uint64_t> stalls{0};  ///< stood still within its stores, as it saw itself
};

/// Publishes at a rate in another process while it exists.
class Writer {
  public:
    Writer(sim::SteamFrameFile& file, double rate_hz, sim::StoreOrder order)
        : told_(new(mmap(nullptr, sizeof(Told), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS,
                         -1, 0)) Told) {
        child_ = fork();
        if (child_ == 0) {
            write(file, rate_hz, order);
            _exit(0);
        }
    }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
    ~Writer() {
        told_->stop = true;
        waitpid(child_, nullptr, 0);
        munmap(told_, sizeof(Told));
    }
    [[nodiscard]] std::uint64_t stalls() const { return told_->stalls; }

  private:
    void write(sim::SteamFrameFile& file, double rate_hz, sim::StoreOrder order) const {
        const auto period_ns = static_cast<std::int64_t>(1e9 / rate_hz);
        constexpr std::int64_t kStall_ns = 2'000;  // it was interrupted: it takes a tenth of that
        const pid_t parent = getppid();
        for (std::int64_t due_ns = time::monotonic_ns(); !told_->stop && getppid() == parent;
             due_ns += period_ns) {
            time::sleep_until_ns(due_ns);
            const sim::SteamFrameRecord record = record_of(file.counter() + 1);
            const std::int64_t begin_ns = time::monotonic_ns();
            file.publish(record, order);
            if (time::monotonic_ns() - begin_ns > kStall_ns) {
                ++told_->stalls;
            }
        }
    }

    Told* told_;
    pid_t child_ = -1;
};

struct Race {
    double rate_hz;
    sim::StoreOrder order;
};

class SteamFrameRace : public testing::TestWithParam<Race> {};

// Ten million reads over the four races. Each is a whole one, whether there is something new or
// not, so that reads fall anywhere within the writer's stores.
TEST_P(SteamFrameRace, GivesNoTornSample) {
    constexpr int kReads = 2'500'000;
    const auto [rate_hz, order] = GetParam();
    const tests::TemporaryFolder folder;
    const std::filesystem::path path = folder / "eye-server.mmap";
    sim::SteamFrameFile file = value_or_throw(sim::SteamFrameFile::create(path));
    file.publish(record_of(1));
    const auto opened = value_or_throw(SharedFile::open(path.string()));
    ASSERT_TRUE(opened.has_value());
    std::uint64_t taken = 0;
    std::uint64_t torn_samples = 0;
    std::uint32_t last_torn = 0;
    std::uint64_t torn = 0;
    std::uint64_t stalls = 0;
    std::uint32_t first = 0;
    std::uint32_t last = 0;
    {
        const Writer writer(file, rate_hz, order);
        Image image{};
        for (int i = 0; i < kReads; ++i) {
            if (!value_or_throw(read_new(*opened, kLayouts[1], std::nullopt, 0, image, torn))) {
                continue;
            }
            ++taken;
            const std::uint32_t counter = decode_header(image).counter;
            first = first == 0 ? counter : first;
            if (counter != last) {
                EXPECT_GE(counter, last);
                last = counter;
            }
            const RecordBytes record = record_in(image, kLayouts[1]);
            if (!std::ranges::equal(record, record_of(counter)) && counter != last_torn) {
                ++torn_samples;
                last_torn = counter;
            }
        }
        stalls = writer.stalls();
    }
    RecordProperty("samples", static_cast<int>(last - first + 1));
    RecordProperty("torn_reads_refused", static_cast<int>(torn));
    RecordProperty("torn_samples_taken", static_cast<int>(torn_samples));
    RecordProperty("writer_stalls", static_cast<int>(stalls));
    EXPECT_GT(last, first) << "the writer wrote";
    EXPECT_GT(taken, 0U);
    // A writer that is interrupted within its stores cannot be seen through by two reads at once.
    EXPECT_LE(torn_samples, stalls) << torn << " reads were refused";
}

INSTANTIATE_TEST_SUITE_P(Rates, SteamFrameRace,
                         testing::Values(Race{90.0, sim::StoreOrder::CounterLast},
                                         Race{90.0, sim::StoreOrder::CounterFirst},
                                         Race{1000.0, sim::StoreOrder::CounterLast},
                                         Race{1000.0, sim::StoreOrder::CounterFirst}));

}  // namespace
}  // namespace gazeloop::drivers::steam_frame
