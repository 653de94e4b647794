#include "runtime/latency/sample_counter.h"

#include <gtest/gtest.h>

#include <initializer_list>

namespace gazeloop::latency {
namespace {

gaze::GazeSample sample(std::uint64_t sequence, std::int64_t time_ns, bool valid = true) {
    gaze::GazeSample result;
    result.sequence = sequence;
    result.device_ns = time_ns;
    result.sampled = {time_ns, time::StampKind::Measured};
    result.eyes[1].valid = valid;
    return result;
}

GazeCounts counts_of(std::initializer_list<gaze::GazeSample> samples) {
    SampleCounter counter;
    for (const gaze::GazeSample& one : samples) {
        counter.add(one);
    }
    return counter.counts();
}

TEST(SampleCounter, CountsNothingElseInAGoodStream) {
    EXPECT_EQ(counts_of({sample(7, 1), sample(8, 2), sample(9, 2)}), (GazeCounts{.received = 3}));
}

TEST(SampleCounter, CountsSamplesThatVouchForNeitherEye) {
    EXPECT_EQ(counts_of({sample(1, 1), sample(2, 2, false)}),
              (GazeCounts{.received = 2, .invalid = 1}));
}

TEST(SampleCounter, CountsGapsAsLost) {
    EXPECT_EQ(counts_of({sample(1, 1), sample(5, 2), sample(7, 3)}),
              (GazeCounts{.received = 3, .lost = 4}));
}

TEST(SampleCounter, ALateSampleWasNotLost) {
    EXPECT_EQ(counts_of({sample(1, 1), sample(3, 3), sample(2, 2), sample(4, 4)}),
              (GazeCounts{.received = 4, .out_of_order = 1}));
}

TEST(SampleCounter, CountsRepeatedSamples) {
    EXPECT_EQ(counts_of({sample(1, 1), sample(3, 3), sample(3, 3)}),
              (GazeCounts{.received = 3, .lost = 1, .out_of_order = 1}));
}

TEST(SampleCounter, ASampleTimeThatIsSetBackCountsOnce) {
    EXPECT_EQ(counts_of({sample(1, 1000), sample(2, 10), sample(3, 20)}),
              (GazeCounts{.received = 3, .out_of_order = 1}));
}

TEST(SampleCounter, ComparesNoTimesOfAClockThatLies) {
    gaze::GazeSample later = sample(2, 10);
    later.sampled = {};
    EXPECT_EQ(counts_of({sample(1, 1000), later}), (GazeCounts{.received = 2}));
}

}  // namespace
}  // namespace gazeloop::latency
