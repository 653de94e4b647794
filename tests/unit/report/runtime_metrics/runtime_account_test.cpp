#include "runtime/report/runtime_metrics/runtime_account.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "runtime/report/session_summary.h"
#include "runtime/session/session_recorder.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/latency/example_frame.h"
#include "tests/unit/report/runtime_metrics/monado_file.h"

namespace gazeloop::report {
namespace {

using latency::example_frame;
using latency::kMs;
using ::testing::HasSubstr;

constexpr std::uint64_t kFrames = 10;

class RuntimeAccountOfASession : public ::testing::Test {
  protected:
    /// Records a session whose environment named the metrics file.
    void record(const std::string& noted_metrics) {
        session::SessionHeader header;
        header.meta.runtime_metrics = noted_metrics;
        const auto recorder = value_or_throw(session::SessionRecorder::create(session_, header));
        for (std::uint64_t i = 0; i < kFrames; ++i) {
            recorder->add(example_frame(i));
            recorder->add(latency::example_gpu(i));
        }
        recorder->close();
    }
    [[nodiscard]] Expected<SessionSummary> summarize(const RuntimeFiles& files) const {
        return report::summarize(value_or_throw(session::OpenSession::open(session_)), files);
    }

    /// Every frame shown 1 ms after what was announced.
    void write_metrics() const {
        MonadoFile file;
        for (std::uint64_t i = 0; i < kFrames; ++i) {
            const frame::FrameStamps stamps = example_frame(i).stamps;
            const auto number = static_cast<std::int64_t>(i) + 1;
            file.session_frame(
                {.frame = number, .display_ns = stamps.display.ns, .begin_ns = stamps.begin.ns});
            file.used(0, number, number, stamps.display.ns - 5 * kMs);
            file.present_info({.frame = number,
                               .display_ns = stamps.display.ns,
                               .desired_ns = stamps.display.ns - 4 * kMs,
                               .actual_ns = stamps.display.ns - 3 * kMs});
        }
        std::ofstream(metrics_, std::ios::binary) << file.bytes();
    }

    tests::TemporaryFolder folder_;
    std::filesystem::path session_ = folder_ / "run.session";
    std::string metrics_ = (folder_ / "m.pb").string();
    std::string csv_ = (folder_ / "w.csv").string();
};

TEST_F(RuntimeAccountOfASession, ChangesWhenItsFramesWereShown) {
    record("");
    write_metrics();
    EXPECT_EQ(value_or_throw(summarize({})).report.gaze_age_at_display.mean_ms, 16.0);
    const SessionSummary joined = value_or_throw(summarize({.metrics = metrics_}));
    EXPECT_EQ(joined.report.gaze_age_at_display.mean_ms, 17.0);
    EXPECT_EQ(joined.report.gaze_age_at_display.kind(), time::StampKind::Profile);
    EXPECT_THAT(joined.runtime.text(), HasSubstr("10 of 10 rendered frames joined"));
    nlohmann::ordered_json json;
    joined.runtime.add_to(json);
    EXPECT_EQ(json["runtime_metrics"]["frames"]["joined"], kFrames);
    EXPECT_EQ(json["runtime_csv"], nullptr);
}

TEST_F(RuntimeAccountOfASession, FindsTheFileThatTheRunNoted) {
    record(metrics_);
    const SessionSummary without = value_or_throw(summarize({}));
    EXPECT_EQ(without.report.gaze_age_at_display.mean_ms, 16.0);
    EXPECT_THAT(without.runtime.text(),
                HasSubstr("XRT_METRICS_FILE was set in this run, but no metrics were read"));
    EXPECT_THAT(without.runtime.text(), HasSubstr("No such file"));
    nlohmann::ordered_json json;
    without.runtime.add_to(json);
    EXPECT_THAT(json["runtime_metrics"]["error"].get<std::string>(), HasSubstr(metrics_));
    write_metrics();
    EXPECT_EQ(value_or_throw(summarize({})).report.gaze_age_at_display.mean_ms, 17.0);
}

TEST_F(RuntimeAccountOfASession, HasBothFilesAtOnce) {
    record("");
    write_metrics();
    std::ofstream csv(csv_);
    for (std::uint64_t i = 0; i < kFrames; ++i) {
        csv << "\"display\"," << i << "," << example_frame(i).stamps.display.ns << ",0\n";
    }
    csv.close();
    const SessionSummary joined = value_or_throw(summarize({.metrics = metrics_, .csv = csv_}));
    EXPECT_THAT(joined.runtime.text(), HasSubstr("10 of 10 rendered frames joined with Monado's"));
    EXPECT_THAT(joined.runtime.text(),
                HasSubstr("10 of 10 rendered frames joined by display time"));
}

TEST_F(RuntimeAccountOfASession, SaysNothingWhereThereIsNothing) {
    record("");
    const SessionSummary summary = value_or_throw(summarize({}));
    EXPECT_EQ(summary.runtime.text(), "");
    nlohmann::ordered_json json;
    summary.runtime.add_to(json);
    EXPECT_EQ(json["runtime_metrics"], nullptr);
}

TEST_F(RuntimeAccountOfASession, RefusesFilesThatWereGivenAndAreOfNoUse) {
    record(metrics_);
    std::ofstream(csv_) << "a,b\n";
    for (const RuntimeFiles& files : {RuntimeFiles{.metrics = csv_}, RuntimeFiles{.csv = csv_},
                                      RuntimeFiles{.metrics = metrics_ + ".none"}}) {
        const auto summary = summarize(files);
        ASSERT_FALSE(summary);
        EXPECT_EQ(summary.error().kind, ErrorKind::BadInput);
        EXPECT_THAT(summary.error().message, HasSubstr(folder_.path().string()));
    }
}

}  // namespace
}  // namespace gazeloop::report
