// What the specification asks of the core functions that the layer stands in for, on Monado with
// the layer and without it: what holds without holds with. CONFORMANCE.md lists the cases.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <vector>

#include "tests/openxr/layered_application.h"

namespace gazeloop::tests {
namespace {

using openxr::typed;

/// Through the layer, or past it.
class Conformance : public testing::TestWithParam<bool> {
  protected:
    Conformance() {
        if (!GetParam()) {
            unsetenv("XR_ENABLE_API_LAYERS");
        }
    }
    LayeredApplication& make() { return application_.emplace(); }

  private:
    LayeredHome home_{{"layer.gaze=fixed:0,0"}};
    std::optional<LayeredApplication> application_;
};

INSTANTIATE_TEST_SUITE_P(Layer, Conformance, testing::Values(false, true),
                         [](const auto& one) { return one.param ? "With" : "Without"; });

XrSystemId system_of(const LayeredApplication& application) {
    auto get = typed<XrSystemGetInfo>(XR_TYPE_SYSTEM_GET_INFO);
    get.formFactor = XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY;
    XrSystemId system = XR_NULL_SYSTEM_ID;
    xrGetSystem(application.instance(), &get, &system);
    return system;
}

TEST_P(Conformance, ViewConfigurationsAreEnumeratedInTwoCalls) {
    LayeredApplication& application = make();
    const XrSystemId system = system_of(application);
    std::uint32_t count = 0;
    ASSERT_EQ(xrEnumerateViewConfigurations(application.instance(), system, 0, &count, nullptr),
              XR_SUCCESS);
    ASSERT_GE(count, 1U);
    std::vector<XrViewConfigurationType> types(count);
    ASSERT_EQ(
        xrEnumerateViewConfigurations(application.instance(), system, count, &count, types.data()),
        XR_SUCCESS);
    for (const XrViewConfigurationType type : types) {
        std::uint32_t views = 0;
        EXPECT_EQ(xrEnumerateViewConfigurationViews(application.instance(), system, type, 0, &views,
                                                    nullptr),
                  XR_SUCCESS);
        std::vector<XrViewConfigurationView> all(
            views, typed<XrViewConfigurationView>(XR_TYPE_VIEW_CONFIGURATION_VIEW));
        EXPECT_EQ(xrEnumerateViewConfigurationViews(application.instance(), system, type, 1, &views,
                                                    all.data()),
                  XR_ERROR_SIZE_INSUFFICIENT);
    }
}

TEST_P(Conformance, AViewConfigurationThatIsNotThereIsRefused) {
    LayeredApplication& application = make();
    auto properties = typed<XrViewConfigurationProperties>(XR_TYPE_VIEW_CONFIGURATION_PROPERTIES);
    EXPECT_EQ(xrGetViewConfigurationProperties(application.instance(), system_of(application),
                                               XR_VIEW_CONFIGURATION_TYPE_PRIMARY_QUAD_VARJO,
                                               &properties),
              XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED);
}

TEST_P(Conformance, ActionSetsAreAttachedOnce) {
    LayeredApplication& application = make();
    const EyeAction eyes = application.make_action("eyes");
    ASSERT_EQ(application.suggest({eyes.action}), XR_SUCCESS);
    application.begin({eyes.set});
    auto attach = typed<XrSessionActionSetsAttachInfo>(XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO);
    attach.countActionSets = 1;
    attach.actionSets = &eyes.set;
    EXPECT_EQ(xrAttachSessionActionSets(application.session(), &attach),
              XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
    EXPECT_EQ(application.suggest({eyes.action}), XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
    auto more = typed<XrActionCreateInfo>(XR_TYPE_ACTION_CREATE_INFO);
    std::strcpy(more.actionName, "late");
    std::strcpy(more.localizedActionName, "late");
    more.actionType = XR_ACTION_TYPE_POSE_INPUT;
    XrAction action = XR_NULL_HANDLE;
    EXPECT_EQ(xrCreateAction(eyes.set, &more, &action), XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
}

TEST_P(Conformance, SetsThatAreNotAttachedAreRefused) {
    LayeredApplication& application = make();
    const EyeAction eyes = application.make_action("eyes");
    const EyeAction other = application.make_action("other");
    auto get = typed<XrActionStateGetInfo>(XR_TYPE_ACTION_STATE_GET_INFO);
    get.action = other.action;
    auto state = typed<XrActionStatePose>(XR_TYPE_ACTION_STATE_POSE);
    EXPECT_EQ(xrGetActionStatePose(application.session(), &get, &state),
              XR_ERROR_ACTIONSET_NOT_ATTACHED);
    application.begin({eyes.set});
    EXPECT_EQ(application.sync({{other.set, XR_NULL_PATH}}), XR_ERROR_ACTIONSET_NOT_ATTACHED);
    EXPECT_EQ(xrGetActionStatePose(application.session(), &get, &state),
              XR_ERROR_ACTIONSET_NOT_ATTACHED);
    auto sources = typed<XrBoundSourcesForActionEnumerateInfo>(
        XR_TYPE_BOUND_SOURCES_FOR_ACTION_ENUMERATE_INFO);
    sources.action = other.action;
    std::uint32_t count = 0;
    // Monado 25 gives another error than XR_ERROR_ACTIONSET_NOT_ATTACHED.
    EXPECT_TRUE(XR_FAILED(
        xrEnumerateBoundSourcesForAction(application.session(), &sources, 0, &count, nullptr)));
}

TEST_P(Conformance, SpacesAreLocatedAtTimesOnly) {
    LayeredApplication& application = make();
    const EyeAction eyes = application.make_action("eyes");
    ASSERT_EQ(application.suggest({eyes.action}), XR_SUCCESS);
    const XrSpace gaze = application.gaze_space(eyes.action);
    const XrSpace view = application.reference_space(XR_REFERENCE_SPACE_TYPE_VIEW);
    const XrSpace local = application.reference_space(XR_REFERENCE_SPACE_TYPE_LOCAL);
    application.begin({eyes.set});
    for (const XrTime never : {XrTime{0}, XrTime{-1}}) {
        EXPECT_EQ(application.locate(view, local, never).result, XR_ERROR_TIME_INVALID);
        EXPECT_EQ(application.locate(gaze, local, never).result, XR_ERROR_TIME_INVALID);
    }
    EXPECT_EQ(application.locate(view, local, application.now()).result, XR_SUCCESS);
    EXPECT_EQ(application.locate(gaze, local, application.now()).result, XR_SUCCESS);
}

TEST_P(Conformance, APoseWithoutARotationIsRefused) {
    LayeredApplication& application = make();
    const EyeAction eyes = application.make_action("eyes");
    auto info = typed<XrActionSpaceCreateInfo>(XR_TYPE_ACTION_SPACE_CREATE_INFO);
    info.action = eyes.action;
    XrSpace space = XR_NULL_HANDLE;
    EXPECT_EQ(xrCreateActionSpace(application.session(), &info, &space), XR_ERROR_POSE_INVALID);
}

TEST_P(Conformance, InactiveActionsHaveNoPlace) {
    LayeredApplication& application = make();
    const EyeAction eyes = application.make_action("eyes");
    const XrSpace gaze = application.gaze_space(eyes.action);  // bound to nothing
    const XrSpace view = application.reference_space(XR_REFERENCE_SPACE_TYPE_VIEW);
    application.begin({eyes.set});
    application.sync_for(eyes, 0.02);
    EXPECT_FALSE(application.active(eyes.action));
    const SaidGaze said = application.locate(gaze, view, application.now());
    EXPECT_EQ(said.result, XR_SUCCESS);
    EXPECT_EQ(said.flags &
                  (XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT),
              0U);
}

TEST_P(Conformance, ASessionIsBegunOnce) {
    LayeredApplication& application = make();
    const EyeAction eyes = application.make_action("eyes");
    application.begin({eyes.set});
    auto info = typed<XrSessionBeginInfo>(XR_TYPE_SESSION_BEGIN_INFO);
    info.primaryViewConfigurationType = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
    EXPECT_EQ(xrBeginSession(application.session(), &info), XR_ERROR_SESSION_RUNNING);
}

}  // namespace
}  // namespace gazeloop::tests
