// The OpenXR API layer in this process, an application that knows nothing of it, on Monado.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <set>
#include <thread>

#include "runtime/openxr_layer/control/layer_files.h"
#include "runtime/openxr_layer/newer_openxr.h"
#include "runtime/openxr_layer/sightings.h"
#include "tests/openxr/layered_application.h"

namespace gazeloop::tests {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr XrSpaceLocationFlags kNominal =
    XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT |
    XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT | XR_SPACE_LOCATION_POSITION_TRACKED_BIT;

glm::dvec3 direction_of(const SaidGaze& said) {
    const auto pose = openxr::from_xr(said.pose);
    return pose ? pose->orientation * glm::dvec3(0.0, 0.0, -1.0) : glm::dvec3(0.0);
}

/// An application that reads gaze of one action.
struct Reader {
    explicit Reader(const std::vector<const char*>& more = {}) : application(more) {
        eyes = application.make_action("eyes");
        EXPECT_EQ(application.suggest({eyes.action}), XR_SUCCESS);
        space = application.gaze_space(eyes.action);
        view = application.reference_space(XR_REFERENCE_SPACE_TYPE_VIEW);
        local = application.reference_space(XR_REFERENCE_SPACE_TYPE_LOCAL);
        application.begin({eyes.set});
    }
    LayeredApplication application;
    EyeAction eyes;
    XrSpace space = XR_NULL_HANDLE;
    XrSpace view = XR_NULL_HANDLE;
    XrSpace local = XR_NULL_HANDLE;
};

TEST(GazeLayer, ListsItsExtensionsOnce) {
    const LayeredHome home({"layer.gaze=fixed:0,0"});
    std::uint32_t count = 0;
    ASSERT_EQ(xrEnumerateInstanceExtensionProperties(nullptr, 0, &count, nullptr), XR_SUCCESS);
    std::vector<XrExtensionProperties> all(count, {XR_TYPE_EXTENSION_PROPERTIES, nullptr, "", 0});
    ASSERT_EQ(xrEnumerateInstanceExtensionProperties(nullptr, count, &count, all.data()),
              XR_SUCCESS);
    for (const char* name :
         {"XR_EXT_eye_gaze_interaction", "XR_GAZELOOP_gaze_sample", "XR_FB_foveation",
          "XR_META_foveation_eye_tracked", "XR_VARJO_quad_views"}) {
        EXPECT_EQ(std::ranges::count_if(
                      all, [&](const auto& one) { return std::string(one.extensionName) == name; }),
                  1)
            << name;
    }
}

TEST(GazeLayer, GivesTheGazeOfASource) {
    const LayeredHome home({"layer.gaze=fixed:10,5"});
    Reader reader({"XR_GAZELOOP_gaze_sample"});
    LayeredApplication& application = reader.application;
    EXPECT_TRUE(application.supports_eye_gaze());
    EXPECT_FALSE(application.active(reader.eyes.action)) << "before the first xrSyncActions";
    application.sync_for(reader.eyes, 0.05);
    EXPECT_TRUE(application.active(reader.eyes.action));
    EXPECT_GE(application.profile_changes(), 1U);

    const XrTime now = application.now();
    const SaidGaze said = application.locate(reader.space, reader.view, now);
    ASSERT_EQ(said.result, XR_SUCCESS);
    EXPECT_EQ(said.flags, kNominal);
    const glm::dvec3 direction = direction_of(said);
    EXPECT_NEAR(glm::degrees(std::atan2(direction.x, -direction.z)), 10.0, 1e-3);
    EXPECT_NEAR(glm::degrees(std::asin(direction.y)), 5.0, 1e-3);
    EXPECT_GE(said.time, now - 5'000'000);
    EXPECT_LE(said.time, now + 100'000'000);
    EXPECT_EQ(said.sample.isAvailable, XR_TRUE);
    EXPECT_EQ(said.sample.sampleTime, said.time);
    EXPECT_EQ(said.sample.eyes[0].isValid, XR_TRUE);
    EXPECT_NEAR(said.sample.eyes[1].direction.y, std::sin(glm::radians(5.0)), 1e-6);
    EXPECT_NEAR(said.sample.eyes[0].confidence, -1.0, 0.0);

    // From the gaze, straight ahead is where it came from.
    const SaidGaze back = application.locate(reader.view, reader.space, now);
    EXPECT_EQ(back.flags, kNominal);
    const auto there = openxr::from_xr(said.pose);
    const auto again = openxr::from_xr(back.pose);
    ASSERT_TRUE(there && again);
    EXPECT_NEAR(std::abs(glm::dot(there->orientation, glm::conjugate(again->orientation))), 1.0,
                1e-6);
    EXPECT_THAT(home.log(), HasSubstr("a stranger"));
    EXPECT_THAT(home.log(), HasSubstr("reads gaze of fixed:10,5"));
}

TEST(GazeLayer, RefusesWhatTheSpecificationRefuses) {
    const LayeredHome home({"layer.gaze=fixed:0,0"});
    LayeredApplication application;
    const EyeAction eyes = application.make_action("eyes");
    const EyeAction declared = application.make_action("declared", 0, true);
    EXPECT_EQ(application.suggest({eyes.action}, "/user/eyes_ext/input/gaze_ext/nothing"),
              XR_ERROR_PATH_UNSUPPORTED);
    EXPECT_EQ(application.suggest({}), XR_ERROR_VALIDATION_FAILURE);
    EXPECT_EQ(application.suggest({eyes.action, declared.action}), XR_SUCCESS);
    const XrPath path = application.path("/user/eyes_ext");
    auto profile = openxr::typed<XrInteractionProfileState>(XR_TYPE_INTERACTION_PROFILE_STATE);
    EXPECT_EQ(xrGetCurrentInteractionProfile(application.session(), path, &profile),
              XR_ERROR_ACTIONSET_NOT_ATTACHED);
    const XrSpace space = application.gaze_space(declared.action, path);
    auto info = openxr::typed<XrActionSpaceCreateInfo>(XR_TYPE_ACTION_SPACE_CREATE_INFO);
    info.action = eyes.action;
    info.subactionPath = path;
    info.poseInActionSpace = openxr::to_xr({});
    XrSpace none = XR_NULL_HANDLE;
    EXPECT_EQ(xrCreateActionSpace(application.session(), &info, &none), XR_ERROR_PATH_UNSUPPORTED);
    application.begin({eyes.set, declared.set});
    EXPECT_EQ(application.suggest({eyes.action}), XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
    ASSERT_EQ(xrGetCurrentInteractionProfile(application.session(), path, &profile), XR_SUCCESS);
    EXPECT_EQ(profile.interactionProfile, XR_NULL_PATH);

    // For the eyes alone.
    ASSERT_EQ(application.sync({{declared.set, path}}), XR_SUCCESS);
    ASSERT_EQ(application.sync({{declared.set, path}}), XR_SUCCESS);
    EXPECT_TRUE(application.active(declared.action, path));
    EXPECT_FALSE(application.active(eyes.action)) << "its set is not synchronized";
    ASSERT_EQ(xrGetCurrentInteractionProfile(application.session(), path, &profile), XR_SUCCESS);
    EXPECT_EQ(profile.interactionProfile,
              application.path("/interaction_profiles/ext/eye_gaze_interaction"));
    const XrSpace view = application.reference_space(XR_REFERENCE_SPACE_TYPE_VIEW);
    EXPECT_EQ(application.locate(space, view, application.now()).flags, kNominal);
    EXPECT_EQ(application.locate(space, view, 0).result, XR_ERROR_TIME_INVALID);

    auto sources = openxr::typed<XrBoundSourcesForActionEnumerateInfo>(
        XR_TYPE_BOUND_SOURCES_FOR_ACTION_ENUMERATE_INFO);
    sources.action = declared.action;
    std::uint32_t count = 0;
    std::vector<XrPath> bound(4);
    ASSERT_EQ(
        xrEnumerateBoundSourcesForAction(application.session(), &sources, 4, &count, bound.data()),
        XR_SUCCESS);
    ASSERT_EQ(count, 1U);
    EXPECT_EQ(bound[0], application.path("/user/eyes_ext/input/gaze_ext/pose"));
}

/// Through the loader, for an application that may have foveation and no gaze.
TEST(GazeLayer, TellsWhereItIsLookedWithoutTellingTheGaze) {
    const LayeredHome home({"layer.gaze=fixed:10,5", "layer.unknown_applications=foveation"});
    Reader reader({"XR_FB_foveation", "XR_FB_foveation_configuration",
                   openxr_layer::newer::kFoveationEyeTrackedName});
    reader.application.sync_for(reader.eyes, 0.05);
    EXPECT_FALSE(reader.application.active(reader.eyes.action));
    EXPECT_EQ(reader.application.locate(reader.space, reader.view, reader.application.now()).flags,
              0U);
    openxr_layer::newer::FoveationEyeTrackedState state{};
    state.type = openxr_layer::newer::kFoveationEyeTrackedState;
    const auto get = openxr::xr_function<openxr_layer::newer::GetFoveationEyeTrackedState>(
        reader.application.instance(), "xrGetFoveationEyeTrackedStateMETA");
    ASSERT_EQ(get(reader.application.session(), &state), XR_SUCCESS);
    EXPECT_EQ(state.flags, openxr_layer::newer::kFoveationEyeTrackedStateValid);
    EXPECT_GT(state.foveationCenter[0].x, 0.05F);
    EXPECT_GT(state.foveationCenter[0].y, 0.02F);
    EXPECT_LT(state.foveationCenter[0].x, 1.0F);
}

TEST(GazeLayer, LetsTheSetWithTheHighestPriorityHaveTheEyes) {
    const LayeredHome home({"layer.gaze=fixed:0,0"});
    LayeredApplication application;
    const EyeAction low = application.make_action("low", 1);
    const EyeAction high = application.make_action("high", 7);
    ASSERT_EQ(application.suggest({low.action, high.action}), XR_SUCCESS);
    application.begin({low.set, high.set});
    application.sync_for(low, 0.02);
    EXPECT_TRUE(application.active(low.action));
    ASSERT_EQ(application.sync({{low.set, XR_NULL_PATH}, {high.set, XR_NULL_PATH}}), XR_SUCCESS);
    EXPECT_FALSE(application.active(low.action));
    EXPECT_TRUE(application.active(high.action));
}

TEST(GazeLayer, LocatesAtAnyTimeWithVelocity) {
    const LayeredHome home({"layer.gaze=sim", "sim.rate_hz=500", "sim.noise_deg=0"});
    Reader reader;
    reader.application.sync_for(reader.eyes, 0.4);
    const XrTime now = reader.application.now();
    std::set<XrTime> times;
    std::size_t turning = 0;
    for (XrTime ago = -20'000'000; ago <= 300'000'000; ago += 4'000'000) {
        const SaidGaze said = reader.application.locate(reader.space, reader.view, now - ago);
        ASSERT_EQ(said.result, XR_SUCCESS);
        if (said.flags == 0) {
            continue;  // a blink for longer than is held
        }
        // The nearest of 500 samples a second, or the newest.
        if (ago > 50'000'000 && said.flags == kNominal) {
            EXPECT_NEAR(static_cast<double>(said.time - (now - ago)), 0.0, 3e6);
        }
        EXPECT_LE(said.time, now);
        times.insert(said.time);
        turning += (said.velocity_flags & XR_SPACE_VELOCITY_ANGULAR_VALID_BIT) != 0 ? 1 : 0;
    }
    EXPECT_GT(times.size(), 40U);
    EXPECT_GT(turning, 40U);
}

TEST(GazeLayer, AsksTheUserAndTellsOfReading) {
    const LayeredHome home({"layer.gaze=fixed:0,0", "layer.unknown_applications=ask"});
    Reader reader;
    reader.application.sync_for(reader.eyes, 0.05);
    EXPECT_FALSE(reader.application.active(reader.eyes.action));
    SaidGaze said = reader.application.locate(reader.space, reader.view, reader.application.now());
    EXPECT_EQ(said.flags, 0U);
    EXPECT_EQ(said.time, 0);
    auto seen = openxr_layer::sightings();
    ASSERT_EQ(seen.size(), 1U);
    EXPECT_EQ(seen[0].permission, "asks");
    EXPECT_EQ(seen[0].read_gaze_utc, "");

    // The user's answer counts in the program that runs.
    using Answer = openxr_layer::Permissions::Answer;
    ASSERT_TRUE(openxr_layer::decide("/proc/self/exe", Answer::Allowed));
    reader.application.sync_for(reader.eyes, 1.2);
    EXPECT_TRUE(reader.application.active(reader.eyes.action));
    said = reader.application.locate(reader.space, reader.view, reader.application.now());
    EXPECT_EQ(said.flags, kNominal);
    seen = openxr_layer::sightings();
    ASSERT_EQ(seen.size(), 1U);
    EXPECT_EQ(seen[0].permission, "allowed");
    EXPECT_NE(seen[0].read_gaze_utc, "");

    for (const auto& entry : std::filesystem::recursive_directory_iterator(home.file("home"))) {
        if (entry.path().string().find("/gazeloop/") == std::string::npos) {
            continue;  // the runtime's own
        }
        if (entry.is_regular_file()) {
            struct stat state{};
            ASSERT_EQ(stat(entry.path().c_str(), &state), 0);
            EXPECT_EQ(state.st_mode & 0777, 0600U) << entry.path();
        }
    }
}

TEST(GazeLayer, ServesTwoInstancesAndComesBack) {
    const LayeredHome home({"layer.gaze=fixed:0,0"});
    for (int round = 0; round < 3; ++round) {
        Reader reader;
        reader.application.sync_for(reader.eyes, 0.02);
        EXPECT_TRUE(reader.application.active(reader.eyes.action)) << round;
    }
}

TEST(GazeLayer, PassesThroughWithoutASource) {
    for (const auto& [settings, said] :
         std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{}, "no gaze source"},
             {{"layer.gaze=telepathy"}, "telepathy"},
             {{"layer.gaze=trace:/nowhere.csv"}, "/nowhere.csv"},
             {{"layer.gaze=fixed:0,0", "layer.no=1"}, "layer.no"}}) {
        const LayeredHome home(settings);
        Reader reader;
        EXPECT_FALSE(reader.application.supports_eye_gaze());
        reader.application.sync_for(reader.eyes, 0.02);
        EXPECT_FALSE(reader.application.active(reader.eyes.action));
        EXPECT_EQ(
            reader.application.locate(reader.space, reader.view, reader.application.now()).flags,
            0U);
        EXPECT_THAT(home.log(), HasSubstr(said));
    }
}

TEST(GazeLayer, PassesOverSettingsOfGazeloopsPictures) {
    const LayeredHome home({"layer.gaze=fixed:0,0"});
    home.write_config("config.toml", "render.scale = 0.5\n[kfr]\nsigma = 2.0\n");
    Reader reader;
    EXPECT_TRUE(reader.application.supports_eye_gaze());
}

}  // namespace
}  // namespace gazeloop::tests
