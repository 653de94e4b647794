#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <string>

#include "drivers/trace/read_trace.h"
#include "runtime/gaze/anatomy.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::drivers {

/// Files of a recording in a folder of their own.
class RecordingFolder {
  public:
    std::string write(const std::string& name, const std::string& bytes) {
        const std::filesystem::path file = folder_ / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << bytes;
        return file.string();
    }
    [[nodiscard]] std::string operator/(const std::string& name) const {
        return (folder_ / name).string();
    }

  private:
    tests::TemporaryFolder folder_;
};

/// What a refused file is told; "" where it is read.
inline std::string refusal(const std::string& file, const ReadOptions& options = {}) {
    const Expected<gaze::GazeTrace> trace = read_trace(file, options);
    return trace ? std::string{} : trace.error().message;
}

inline double right_deg(const glm::dvec3& direction) {
    return glm::degrees(std::atan2(direction.x, -direction.z));
}

inline double up_deg(const glm::dvec3& direction) {
    return glm::degrees(std::atan2(direction.y, std::hypot(direction.x, direction.z)));
}

inline void expect_near(const glm::dvec3& actual, const glm::dvec3& expected,
                        double tolerance = 1e-12) {
    EXPECT_LT(glm::length(actual - expected), tolerance)
        << actual.x << ' ' << actual.y << ' ' << actual.z;
}

/// A trace whose eyes were told apart: the left one lies at -X and the rays meet.
inline void expect_anatomy(const gaze::GazeTrace& trace) {
    const gaze::Anatomy anatomy = gaze::anatomy_of(trace.samples);
    EXPECT_EQ(anatomy.verdict, gaze::AnatomyVerdict::Agrees) << trace.report.axes;
    EXPECT_GT(anatomy.apart_m.value_or(0.0), 0.045) << trace.report.axes;
    ASSERT_TRUE(anatomy.vergence_deg);
    EXPECT_GE(anatomy.vergence_deg->median, 0.0);
}

}  // namespace gazeloop::drivers
