#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <iomanip>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "runtime/session/session_file.h"
#include "tests/support/faults/injected.h"
#include "tests/support/openxr_validation.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {

inline constexpr double kRateHz = 120.0;
inline constexpr std::size_t kSamples = 6000;  // 50 s: no run lasts as long
inline constexpr std::int64_t kMs = 1'000'000;
/// How old the layer's gaze is at the least: kDelay in eye_gaze.cpp.
inline constexpr std::int64_t kDelayNs = 5 * kMs;
inline constexpr double kDistanceM = 1.5;  ///< the setting gaze.fixation_distance_m

inline std::int64_t sample_ns(std::size_t i) {
    return std::llround(static_cast<double>(i) / kRateHz * 1e9);
}

/// Where the wearer looks from between the eyes: a slow curve, no two places the same.
inline glm::dvec3 direction_of(std::size_t i) {
    const double t = static_cast<double>(i) / kRateHz * 2.0 * std::numbers::pi;
    const double azimuth = glm::radians(12.0 * std::sin(t / 1.7));
    const double elevation = glm::radians(6.0 * std::cos(t / 2.3));
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
            -std::cos(azimuth) * std::cos(elevation)};
}

/// The layers with validation first, which is nearest to the program.
inline Environment gaze_layers(const std::string& plan, const std::string& gaze_file,
                               const std::string& validation_file) {
    Environment environment{
        {"XR_API_LAYER_PATH",
         faults_folder() + "/openxr:/usr/share/openxr/1/api_layers/explicit.d"},
        {"XR_ENABLE_API_LAYERS", "XR_APILAYER_LUNARG_core_validation:XR_APILAYER_GAZELOOP_faults"},
        {"GAZELOOP_OPENXR_FAULTS", plan},
        {"GAZELOOP_OPENXR_GAZE", gaze_file}};
    for (const auto& variable : openxr_validation_to(validation_file)) {
        environment.push_back(variable);
    }
    return environment;
}

/// Monado lists eye gaze and has no tracker: a layer between the program and Monado supplies the
/// gaze, from a file (tests/support/openxr_layer). The validation layer stands above both, and sees
/// every call of the program.
class EyeGaze : public testing::Test {
  protected:
    void SetUp() override {
        std::ostringstream lines;
        lines << std::setprecision(17);
        for (std::size_t i = 0; i < kSamples; ++i) {
            const glm::dvec3 to = direction_of(i);
            lines << static_cast<double>(sample_ns(i)) * 1e-9 << ' ' << to.x << ' ' << to.y << ' '
                  << to.z << '\n';
        }
        gaze_file_ = folder_.write("gaze.txt", lines.str());
    }

    /// A recorded run of 80 frames with the layer's gaze.
    ProgramResult run(const std::string& plan, const std::vector<std::string>& more = {}) {
        std::vector<std::string> words{"run",
                                       "--gaze",
                                       "openxr",
                                       "--frames",
                                       "80",
                                       "--record",
                                       session(),
                                       "--set",
                                       "render.scale=0.05",
                                       "--set",
                                       "vulkan.validation=true",
                                       "--set",
                                       "gaze.hold_ms=100000"};
        words.insert(words.end(), more.begin(), more.end());
        return run_gazeloop(words,
                            {.environment = gaze_layers(plan, gaze_file_, validation_file())});
    }

    void expect_no_validation_messages(const ProgramResult& result) const {
        EXPECT_THAT(result.out + result.err, ::testing::HasSubstr(kOpenXrValidationIsOn));
        EXPECT_EQ(openxr_validation_messages(validation_file()), "");
        EXPECT_THAT(result.err, ::testing::Not(::testing::HasSubstr("Vulkan validation")));
    }

    [[nodiscard]] session::SessionFile recorded() const {
        return value_or_throw(session::read_session(session()));
    }
    [[nodiscard]] std::string session() const { return folder_.file("session.gaze"); }
    [[nodiscard]] std::string validation_file() const { return folder_.file("validation.txt"); }

    ScratchFolder folder_;
    std::string gaze_file_;
};

/// Which line of the file a sample is, by the runtime's clock, whose first reading is line 0.
inline std::size_t line_of(const session::SessionFile& session, const gaze::GazeSample& sample) {
    const auto first = std::ranges::find_if(
        session.samples, [](const auto& one) { return one.sample.eyes[0].valid; });
    return static_cast<std::size_t>(std::llround(
        static_cast<double>(sample.device_ns - first->sample.device_ns) * 1e-9 * kRateHz));
}

inline std::vector<std::string> tracker_events(const session::SessionFile& session) {
    std::vector<std::string> texts;
    for (const session::RecordedEvent& event : session.events) {
        if (event.kind == "tracker") {
            texts.push_back(event.text);
        }
    }
    return texts;
}

inline double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

}  // namespace gazeloop::tests
