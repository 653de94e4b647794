// Samples that another process writes while they are read: whole, or not taken.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstring>
#include <optional>
#include <vector>

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
    static constexpr std::uint32_t kMost = 1U << 16U;  ///< more samples than any race has
    std::atomic<bool> stop{false};
    /// Of each counter, whether the writer stood still within its stores, as it saw itself.
    std::array<std::atomic<bool>, kMost> stood_still{};
};

/// Publishes at a rate in another process while it exists.
class Writer {
  public:
    Writer(sim::SteamFrameFile& file, double rate_hz, sim::StoreOrder order)
        : told_(new(mmap(nullptr, sizeof(Told), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS,
                         -1, 0)) Told),
          child_(fork()) {
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
    /// Whether this sample's stores took longer than the two reads of a sample lie apart.
    [[nodiscard]] bool stood_still(std::uint32_t counter) const {
        return told_->stood_still.at(counter % Told::kMost);
    }

  private:
    void write(sim::SteamFrameFile& file, double rate_hz, sim::StoreOrder order) const {
        const auto period_ns = static_cast<std::int64_t>(1e9 / rate_hz);
        const pid_t parent = getppid();
        for (std::int64_t due_ns = time::monotonic_ns(); !told_->stop && getppid() == parent;
             due_ns += period_ns) {
            time::sleep_until_ns(due_ns);
            const sim::SteamFrameRecord record = record_of(file.counter() + 1);
            const std::int64_t begin_ns = time::monotonic_ns();
            value_or_throw(file.publish(record, order));
            if (time::monotonic_ns() - begin_ns > kSettle_ns) {
                told_->stood_still.at(file.counter() % Told::kMost) = true;
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

// Ten million looks over the four races, so that they fall anywhere within the writer's stores.
// What is new is read as the program reads it.
TEST_P(SteamFrameRace, GivesNoTornSample) {
    constexpr int kReads = 2'500'000;
    const auto [rate_hz, order] = GetParam();
    const tests::TemporaryFolder folder;
    const std::filesystem::path path = folder / "eye-server.mmap";
    sim::SteamFrameFile file = value_or_throw(sim::SteamFrameFile::create(path));
    value_or_throw(file.publish(record_of(1)));
    const auto opened = value_or_throw(SharedFile::open(path.string()));
    ASSERT_TRUE(opened.has_value());
    std::uint64_t taken = 0;
    std::uint64_t stalls = 0;
    std::uint64_t torn = 0;
    std::uint32_t first = 0;
    std::uint32_t last = 0;
    std::vector<std::uint32_t> torn_counters;
    {
        const Writer writer(file, rate_hz, order);
        Image image{};
        for (int i = 0; i < kReads; ++i) {
            const auto known = last == 0 ? std::nullopt : std::optional(last);
            if (!value_or_throw(read_new(*opened, kLayouts[1], known, kSettle_ns, image, torn))) {
                continue;
            }
            ++taken;
            const std::uint32_t counter = decode_header(image).counter;
            first = first == 0 ? counter : first;
            EXPECT_GE(counter, last);
            last = counter;
            const RecordBytes record = record_in(image, kLayouts[1]);
            if (std::ranges::equal(record, record_of(counter))) {
                continue;
            }
            torn_counters.push_back(counter);
        }
        for (std::uint32_t counter = first; counter <= last; ++counter) {
            stalls += writer.stood_still(counter) ? 1 : 0;
        }
        for (const std::uint32_t counter : torn_counters) {
            // Its counter came with the record before it or after it.
            EXPECT_TRUE(writer.stood_still(counter) || writer.stood_still(counter + 1))
                << "sample " << counter << " was torn, and nothing had held up its writer";
        }
    }
    RecordProperty("samples", static_cast<int>(last - first + 1));
    RecordProperty("torn_reads_refused", static_cast<int>(torn));
    RecordProperty("torn_samples_taken", static_cast<int>(torn_counters.size()));
    RecordProperty("writer_stalls", static_cast<int>(stalls));
    EXPECT_GT(last, first) << "the writer wrote";
    // Most, where the reader has a core; enough to have been raced, where it shares one with
    // others.
    EXPECT_GT(10 * taken, last - first) << torn << " looks found a sample half written";
    if (rate_hz >= 1000.0) {
        // Else next to nothing was judged. A writer that sleeps for longer often begins slowly.
        EXPECT_LT(2 * stalls, last - first) << "the writer was held up too often";
    }
}

INSTANTIATE_TEST_SUITE_P(Rates, SteamFrameRace,
                         testing::Values(Race{90.0, sim::StoreOrder::CounterLast},
                                         Race{90.0, sim::StoreOrder::CounterFirst},
                                         Race{1000.0, sim::StoreOrder::CounterLast},
                                         Race{1000.0, sim::StoreOrder::CounterFirst}));

}  // namespace
}  // namespace gazeloop::drivers::steam_frame
