#include "drivers/trace/htc_vive_pro.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <string>
#include <vector>

#include "tests/support/recorded_data.h"
#include "tests/unit/drivers/trace/trace_text.h"

namespace gazeloop::drivers {
namespace {

gaze::GazeTrace read_rows(const std::string& rows) {
    return value_or_throw(read_text(fmt::format("{}\r\n{}", kHtcHeader, rows)));
}

gaze::GazeSample read_row(const std::string& row) { return read_rows(row).samples.front(); }

double right_deg(const glm::dvec3& direction) {
    return glm::degrees(std::atan2(direction.x, -direction.z));
}

double up_deg(const glm::dvec3& direction) {
    return glm::degrees(std::asin(std::clamp(direction.y, -1.0, 1.0)));
}

void expect_near(const glm::dvec3& actual, const glm::dvec3& expected) {
    EXPECT_LT(glm::length(actual - expected), 1e-12)
        << actual.x << ' ' << actual.y << ' ' << actual.z;
}

TEST(HtcVivePro, TurnsLeftForwardAxesIntoOurs) {
    // Left eye: to the wearer's right (-X there) and up; right eye: to the left and down.
    const gaze::GazeSample sample = read_row(htc_row(0, "-0.6;0;0.8", "0.6;-0.64;0.48"));
    expect_near(sample.eyes[0].direction, {0.6, 0.0, -0.8});
    expect_near(sample.eyes[1].direction, {-0.6, -0.64, -0.48});
    expect_near(sample.eyes[0].origin_m, {-0.038, 0.002, 0.037});
    expect_near(sample.eyes[1].origin_m, {0.032, 0.001, 0.036});
    EXPECT_DOUBLE_EQ(sample.eyes[0].openness, 0.9);
    EXPECT_DOUBLE_EQ(sample.eyes[1].openness, 0.8);
    EXPECT_DOUBLE_EQ(sample.eyes[0].confidence, -1.0);
}

TEST(HtcVivePro, MakesDirectionsUnitVectors) {
    const gaze::GazeSample sample = read_row(htc_row(0, "0.30001;0.1;0.95"));
    EXPECT_NEAR(glm::length(sample.eyes[0].direction), 1.0, 1e-15);
}

TEST(HtcVivePro, BelievesAnEyeOnlyWithItsBitAndADirection) {
    const auto left_valid = [](std::string_view flags, std::string_view direction) {
        std::string row = htc_row(0, direction);
        row.replace(row.find(";31;"), 4, fmt::format(";{};", flags));
        return read_row(row).eyes[0].valid;
    };
    EXPECT_TRUE(left_valid("31", "0;0;1"));
    EXPECT_TRUE(left_valid("27", "0;0;1")) << "no pupil";
    for (const std::string_view flags : {"0", "8", "24", "25", "29", "-1", "63"}) {
        EXPECT_FALSE(left_valid(flags, "0;0;1")) << flags;
    }
    EXPECT_FALSE(left_valid("31", "0;0;0"));
}

TEST(HtcVivePro, TakesOpennessOutsideItsRangeAsUnknown) {
    std::string row = htc_row(0);
    row.replace(row.find(";0.9;"), 5, ";-1;");
    EXPECT_DOUBLE_EQ(read_row(row).eyes[0].openness, -1.0);
}

TEST(HtcVivePro, CountsTimeFromTheFirstRowInHundredsOfNanoseconds) {
    // Ticks since the year 1: as nanoseconds they would not fit 64 bits.
    const gaze::GazeTrace trace =
        read_rows(htc_row(638342794000115346) + htc_row(638342794000195116));
    ASSERT_EQ(trace.samples.size(), 2U);
    EXPECT_EQ(trace.samples[0].device_ns, 0);
    EXPECT_EQ(trace.samples[1].device_ns, 7'977'000);
    EXPECT_EQ(trace.samples[1].sampled, (time::Stamp{7'977'000, time::StampKind::Modelled}));
    EXPECT_FALSE(trace.samples[1].arrived.known());
    EXPECT_EQ(trace.samples[1].sequence, 1U);
}

TEST(HtcVivePro, MirrorsTheHelmetFromUnity) {
    // Unity: 1 m right, 2 m up, 3 m forward.
    const auto head = [](std::string_view helmet) {
        return *read_row(htc_row(0, "0;0;1", "0;0;1", helmet)).head;
    };
    expect_near(head("1;2;3;0;0;0").position_m, {1.0, 2.0, -3.0});

    const glm::dvec3 ahead{0.0, 0.0, -1.0};
    const glm::dvec3 right{1.0, 0.0, 0.0};
    // Unity turns to the right for positive y and down for positive x; positive z tilts the head to
    // the left (its right side rises), there and here.
    EXPECT_NEAR(right_deg(head("0;0;0;0;30;0").orientation * ahead), 30.0, 1e-9);
    EXPECT_NEAR(up_deg(head("0;0;0;20;0;0").orientation * ahead), -20.0, 1e-9);
    EXPECT_NEAR(up_deg(head("0;0;0;0;0;10").orientation * right), 10.0, 1e-9);
    EXPECT_NEAR(up_deg(head("0;0;0;340;0;0").orientation * ahead), 20.0, 1e-9);
}

TEST(HtcVivePro, AppliesRollThenPitchThenYaw) {
    const glm::dquat orientation =
        read_row(htc_row(0, "0;0;1", "0;0;1", "0;0;0;20;90;30")).head->orientation;
    // Pitched down by 20 deg and yawed right by 90: forward points to the right and down.
    const glm::dvec3 forward = orientation * glm::dvec3{0.0, 0.0, -1.0};
    expect_near(forward, {std::cos(glm::radians(20.0)), -std::sin(glm::radians(20.0)), 0.0});
    // Rolled first: the head's right side is up by 30 deg in the pitched frame.
    const glm::dvec3 right = orientation * glm::dvec3{1.0, 0.0, 0.0};
    EXPECT_NEAR(right.y, std::sin(glm::radians(30.0)) * std::cos(glm::radians(20.0)), 1e-12);
}

// ---- Recordings of people -----------------------------------------------------------------------

constexpr const char* kRecordings = "traces/htc_vive_pro";

std::vector<gaze::GazeTrace> recorded() {
    std::vector<std::string> files;
    for (const auto& entry :
         std::filesystem::directory_iterator(tests::recorded_data(kRecordings))) {
        files.push_back(entry.path().string());
    }
    std::sort(files.begin(), files.end());
    std::vector<gaze::GazeTrace> traces;
    for (const std::string& file : files) {
        Expected<gaze::GazeTrace> trace = read_trace(file);
        if (trace) {
            traces.push_back(std::move(*trace));
        } else {
            ADD_FAILURE() << trace.error().message;
        }
    }
    return traces;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
    const auto n = static_cast<double>(a.size());
    double sum_a = 0.0;
    double sum_b = 0.0;
    double aa = 0.0;
    double bb = 0.0;
    double ab = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum_a += a[i];
        sum_b += b[i];
        aa += a[i] * a[i];
        bb += b[i] * b[i];
        ab += a[i] * b[i];
    }
    return (n * ab - sum_a * sum_b) /
           std::sqrt((n * aa - sum_a * sum_a) * (n * bb - sum_b * sum_b));
}

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

/// Velocities over 3 rows (about 24 ms) in which one eye stays valid.
struct Velocities {
    std::vector<double> eye_right, eye_up;    ///< eye in head, deg/s, slower than 100
    std::vector<double> head_right, head_up;  ///< at the same times
    std::vector<double> in_head, in_world;    ///< speed of the gaze while the head turns
};

Velocities velocities(const gaze::GazeTrace& trace, std::size_t eye) {
    constexpr std::size_t kRows = 3;
    constexpr double kSaccade_deg_per_s = 100.0;
    constexpr double kTurning_deg_per_s = 10.0;
    const glm::dvec3 ahead{0.0, 0.0, -1.0};
    Velocities v;
    for (std::size_t i = 0; i + kRows < trace.samples.size(); ++i) {
        const gaze::GazeSample& a = trace.samples[i];
        const gaze::GazeSample& b = trace.samples[i + kRows];
        bool valid = true;
        for (std::size_t k = i; k <= i + kRows; ++k) {
            valid = valid && trace.samples[k].eyes[eye].valid;
        }
        const double seconds = static_cast<double>(b.sampled.ns - a.sampled.ns) * 1e-9;
        if (!valid || seconds > 0.06) {
            continue;
        }
        const glm::dvec3& gaze_a = a.eyes[eye].direction;
        const glm::dvec3& gaze_b = b.eyes[eye].direction;
        const glm::dvec3 head_a = a.head->orientation * ahead;
        const glm::dvec3 head_b = b.head->orientation * ahead;
        const double eye_right = (right_deg(gaze_b) - right_deg(gaze_a)) / seconds;
        const double eye_up = (up_deg(gaze_b) - up_deg(gaze_a)) / seconds;
        const double head_right =
            std::remainder(right_deg(head_b) - right_deg(head_a), 360.0) / seconds;
        const double head_up = (up_deg(head_b) - up_deg(head_a)) / seconds;
        if (std::hypot(eye_right, eye_up) < kSaccade_deg_per_s) {
            v.eye_right.push_back(eye_right);
            v.eye_up.push_back(eye_up);
            v.head_right.push_back(head_right);
            v.head_up.push_back(head_up);
        }
        if (std::hypot(head_right, head_up) > kTurning_deg_per_s) {
            v.in_head.push_back(angle_deg(gaze_a, gaze_b) / seconds);
            v.in_world.push_back(
                angle_deg(a.head->orientation * gaze_a, b.head->orientation * gaze_b) / seconds);
        }
    }
    return v;
}

TEST(HtcViveProRecordings, HaveTheEyesOnTheirSidesAndLookForward) {
    if (const std::string missing = tests::no_recorded_data(kRecordings); !missing.empty()) {
        GTEST_SKIP() << missing;
    }
    const std::vector<gaze::GazeTrace> traces = recorded();
    ASSERT_FALSE(traces.empty()) << kRecordings << " is there and holds nothing";
    for (const gaze::GazeTrace& trace : traces) {
        std::vector<double> left_x;
        std::vector<double> right_x;
        std::vector<double> vergence;
        for (const gaze::GazeSample& sample : trace.samples) {
            left_x.push_back(sample.eyes[0].origin_m.x);
            right_x.push_back(sample.eyes[1].origin_m.x);
            if (sample.eyes[0].valid && sample.eyes[1].valid) {
                EXPECT_LT(sample.eyes[0].direction.z, 0.0);
                vergence.push_back(right_deg(sample.eyes[0].direction) -
                                   right_deg(sample.eyes[1].direction));
            }
        }
        EXPECT_NEAR(median(left_x), -0.035, 0.006) << trace.file;
        EXPECT_NEAR(median(right_x), 0.030, 0.006) << trace.file;
        EXPECT_GE(median(vergence), 0.0) << trace.file;
        EXPECT_LT(median(vergence), 5.0) << trace.file;
        EXPECT_EQ(trace.report.rows_dropped(), 0U) << trace.file;
        EXPECT_EQ(trace.report.count(gaze::TraceFindingKind::OutOfOrder).rows, 0U) << trace.file;
        RecordProperty(std::filesystem::path(trace.file).stem().string() + " vergence deg",
                       fmt::format("{:.3f}", median(vergence)));
    }
}

TEST(HtcViveProRecordings, ShowTheVestibuloOcularReflex) {
    if (const std::string missing = tests::no_recorded_data(kRecordings); !missing.empty()) {
        GTEST_SKIP() << missing;
    }
    const std::vector<gaze::GazeTrace> traces = recorded();
    ASSERT_FALSE(traces.empty()) << kRecordings << " is there and holds nothing";
    for (const gaze::GazeTrace& trace : traces) {
        for (const std::size_t eye : {0U, 1U}) {
            const Velocities v = velocities(trace, eye);
            const double yaw = correlation(v.eye_right, v.head_right);
            const double pitch = correlation(v.eye_up, v.head_up);
            fmt::print(
                "{} {}: yaw {:.3f}, pitch {:.3f}; gaze while the head turns, median {:.1f} "
                "deg/s in head, {:.1f} in world\n",
                std::filesystem::path(trace.file).stem().string(), gaze::kEyeNames[eye], yaw, pitch,
                median(v.in_head), median(v.in_world));
            EXPECT_LT(yaw, -0.1) << trace.file;
            EXPECT_LT(pitch, -0.02) << trace.file;
            EXPECT_LT(median(v.in_world), median(v.in_head)) << trace.file;
        }
    }
}

}  // namespace
}  // namespace gazeloop::drivers
