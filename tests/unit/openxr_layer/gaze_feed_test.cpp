// Sources that end or fail under an application that runs.
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "drivers/gaze_source.h"
#include "runtime/openxr_layer/gaze_feed.h"
#include "tests/unit/openxr_layer/mock_home.h"

namespace gazeloop::openxr_layer {
namespace {

constexpr std::int64_t kBegin_ns = 5'000'000'000;
constexpr std::int64_t kPoll_ns = 10'000'000;

/// One sample of open eyes a poll; after some, it fails or is finished.
class ShortSource final : public drivers::GazeSource {
  public:
    enum class End : std::uint8_t { Fails, Finishes };
    ShortSource(int polls, End end) : left_(polls), end_(end) {}

    void poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) override {
        if (left_-- == 0 && end_ == End::Fails) {
            throw std::runtime_error("the cable is out");
        }
        gaze::GazeSample sample;
        sample.sequence = sequence_++;
        sample.sampled = sample.arrived = {now_ns, time::StampKind::Measured};
        for (gaze::EyeRay& ray : sample.eyes) {
            ray.valid = true;
        }
        samples.push_back(sample);
    }
    [[nodiscard]] bool finished() const override { return end_ == End::Finishes && left_ <= 0; }
    [[nodiscard]] std::string description() const override { return "a short source"; }

  private:
    int left_;
    End end_;
    std::uint64_t sequence_ = 0;
};

/// A feed of short sources, and how many were made.
struct Feed {
    explicit Feed(ShortSource::End end)
        : feed("short",
               [this, end](std::int64_t) {
                   ++made;
                   return std::make_unique<ShortSource>(3, end);
               },
               {}) {}
    [[nodiscard]] GazeAt at(std::int64_t now_ns) {
        return feed.take(now_ns,
                         [&](const GazeHistory& history) { return history.at(now_ns, now_ns); });
    }
    [[nodiscard]] std::uint64_t last_sequence(std::int64_t now_ns) {
        return feed.take(now_ns, [](const GazeHistory& history) {
            return history[history.count() - 1].sample.sequence;
        });
    }
    int made = 0;
    GazeFeed feed;
};

TEST(GazeFeed, HoldsTheGazeOfASourceThatFailsAndThenHasNone) {
    const Home home;
    Feed feed(ShortSource::End::Fails);
    for (int i = 0; i < 3; ++i) {
        EXPECT_TRUE(feed.at(kBegin_ns + i * kPoll_ns).nominal);
    }
    const std::int64_t last_ns = kBegin_ns + 2 * kPoll_ns;
    const HistoryPolicy policy;
    EXPECT_TRUE(feed.at(last_ns + policy.stale_ns).nominal);
    const GazeAt held = feed.at(last_ns + policy.stale_ns + policy.hold_ns);
    EXPECT_NE(held.seen, nullptr);
    EXPECT_FALSE(held.nominal);
    EXPECT_TRUE(feed.feed.tracks(last_ns + 1'000'000'000));
    EXPECT_EQ(feed.at(last_ns + policy.stale_ns + policy.hold_ns + 1).seen, nullptr);
    EXPECT_FALSE(feed.feed.tracks(last_ns + 1'000'000'001));
    EXPECT_EQ(feed.made, 1) << "it is left alone";
    const std::string log = home.log();
    const std::size_t said = log.find("the cable is out");
    ASSERT_NE(said, std::string::npos) << log;
    EXPECT_EQ(log.find("the cable is out", said + 1), std::string::npos) << "once is enough";
}

TEST(GazeFeed, BeginsAnewWhereASourceIsFinishedAndCountsOn) {
    const Home home;
    Feed feed(ShortSource::End::Finishes);
    for (std::uint64_t i = 0; i < 10; ++i) {
        const std::int64_t now_ns = kBegin_ns + static_cast<std::int64_t>(i) * kPoll_ns;
        EXPECT_EQ(feed.last_sequence(now_ns), i);
    }
    EXPECT_GT(feed.made, 2);
}

}  // namespace
}  // namespace gazeloop::openxr_layer
