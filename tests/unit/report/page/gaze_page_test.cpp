#include "runtime/report/gaze_page/gaze_page.h"
#include "runtime/memory/long_vector.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "runtime/report/gaze_events_text.h"
#include "runtime/report/gaze_page/gaze_bins.h"
#include "runtime/report/gaze_page/histogram.h"
#include "tests/unit/gaze/pair_of_eyes.h"

namespace gazeloop::report::page {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(GazeHistogram, CountsEveryFiniteNumberOnce) {
    memory::LongVector<double> values;
    for (int i = 0; i < 1000; ++i) {
        values.push_back(i * 0.37);
    }
    values.push_back(std::nan(""));
    values.push_back(std::numeric_limits<double>::infinity());
    values.push_back(1e300);
    const Histogram found = histogram(values, 0.01);
    EXPECT_EQ(found.known, 1001U);
    EXPECT_EQ(std::accumulate(found.counts.begin(), found.counts.end(), found.above), 1001U);
    EXPECT_EQ(found.width, 10.0);
    EXPECT_EQ(found.first, 0.0);
    EXPECT_EQ(found.above, 1U) << "all else is within the bin of the 99th percentile";
    EXPECT_EQ(histogram({}, 1.0).counts.size(), 0U);
    EXPECT_EQ(histogram(memory::LongVector<double>(5, 3.0), 1.0).counts,
              (std::vector<std::uint64_t>{5}));
    EXPECT_EQ(histogram({-5.0, -5.0, 5.0}, 1.0).first, -5.0);
}

TEST(GazeBins, HoldEverySampleOnceWhateverTheLength) {
    for (const std::size_t count : {std::size_t{1}, std::size_t{400}, 2 * kMostBins + 17}) {
        std::vector<gaze::GazeSample> samples(count);
        for (std::size_t i = 0; i < count; ++i) {
            samples[i].sampled = {static_cast<std::int64_t>(i) * 1'000'000,
                                  time::StampKind::Modelled};
            samples[i].eyes[0].valid = true;
            samples[i].eyes[0].direction = {std::sin(0.01 * static_cast<double>(i % 30)), 0.0,
                                            -std::cos(0.01 * static_cast<double>(i % 30))};
        }
        const GazeBins bins = gaze_bins(samples, gaze::recorded_events(samples));
        EXPECT_LE(bins.bins.size(), kMostBins);
        std::uint64_t all = 0;
        for (const GazeBin& bin : bins.bins) {
            all += bin.samples;
            EXPECT_EQ(bin.angles[0].count, bin.samples);
            EXPECT_EQ(bin.angles[1].count, 0U) << "never seen";
            EXPECT_EQ(std::accumulate(bin.by_event.begin(), bin.by_event.end(), std::uint64_t{0}),
                      bin.samples);
            EXPECT_LE(bin.angles[0].least_deg, bin.angles[0].greatest_deg);
        }
        EXPECT_EQ(all, count);
        std::uint64_t in_all_parts = 0;
        for (const GazeBin& part : in_parts(bins, 24)) {
            in_all_parts += part.samples;
        }
        EXPECT_EQ(in_all_parts, count);
    }
    EXPECT_TRUE(gaze_bins({}, {}).bins.empty());
}

gaze::GazeTrace trace_of(const std::string& file) {
    return {.file = file,
            .format = "gazeloop",
            .device = "a tracker",
            .samples = gaze::pair_of_eyes(),
            .report = {}};
}

TEST(GazePage, ShowsTextsAsTheyAreAndNeedsNothingElse) {
    const gaze::GazeTrace trace = trace_of("<script>alert(1)</script>.csv");
    const GazeFindings found = gaze_findings(trace);
    const std::array<PageRecording, 1> recordings{
        {{trace, found, "half of <b>its</b> rows cannot be used"}}};
    const std::string html = gaze_page(recordings, nullptr);
    EXPECT_THAT(html, Not(HasSubstr("<script>alert")));
    EXPECT_THAT(html, HasSubstr("&lt;script&gt;alert(1)&lt;/script&gt;.csv"));
    EXPECT_THAT(html, HasSubstr("half of &lt;b&gt;its"));
    EXPECT_THAT(html, Not(HasSubstr("src=")));
    EXPECT_LT(html.size(), 3'000'000U);
}

TEST(GazePage, DoesWithoutSamplesThatKnowTheirTime) {
    gaze::GazeTrace trace = trace_of("s.gaze");
    for (gaze::GazeSample& sample : trace.samples) {
        sample.sampled = {};
    }
    const GazeFindings found = gaze_findings(trace);
    const std::array<PageRecording, 1> recordings{{{trace, found, {}}}};
    EXPECT_THAT(gaze_page(recordings, nullptr), HasSubstr("unknown"));
}

TEST(GazeEvents, AreCsvForPrograms) {
    const std::vector<gaze::RecordedEvent> events{{.event = gaze::EyeEvent::Saccade,
                                                   .begin_ns = 3'000'000'000,
                                                   .end_ns = 3'040'000'000,
                                                   .samples = 20,
                                                   .from = {0.0, 0.0, -1.0},
                                                   .to = {0.0, std::sqrt(0.5), -std::sqrt(0.5)},
                                                   .middle = {0.0, 0.0, -1.0},
                                                   .amplitude_deg = 90.0,
                                                   .peak_deg_per_s = 600.0,
                                                   .deviation_deg = 30.0},
                                                  {.event = gaze::EyeEvent::Lost,
                                                   .begin_ns = 3'040'000'000,
                                                   .end_ns = 3'300'000'000,
                                                   .samples = 130,
                                                   .unseen_ns = 200'000'000}};
    EXPECT_EQ(events_csv(events, 1'000'000'000),
              "event,begin_s,end_s,duration_ms,samples,amplitude_deg,peak_deg_per_s,deviation_deg,"
              "from_azimuth_deg,from_elevation_deg,to_azimuth_deg,to_elevation_deg,"
              "middle_azimuth_deg,middle_elevation_deg,unseen_ms\n"
              "saccade,2.000000,2.040000,40.000,20,90.0000,600.00,30.0000,0.000,0.000,0.000,45.000,"
              "0.000,0.000,\n"
              "lost,2.040000,2.300000,260.000,130,,,,,,,,,,200.000\n");
}

}  // namespace
}  // namespace gazeloop::report::page
