#pragma once

#include <gtest/gtest.h>

#include "tests/unit/openxr_layer/mock_application.h"

namespace gazeloop::openxr_layer {

/// An application that reads gaze: one action, and its space, VIEW and LOCAL as spaces 0, 1 and 2.
inline void make_gaze_reader(MockApplication& application) {
    ASSERT_EQ(application.make_session(), XR_SUCCESS);
    ASSERT_EQ(application.make_set(), XR_SUCCESS);
    ASSERT_EQ(application.make_action(application.sets[0], true), XR_SUCCESS);
    ASSERT_EQ(application.suggest(application.actions), XR_SUCCESS);
    ASSERT_EQ(application.attach(), XR_SUCCESS);
    ASSERT_EQ(application.make_gaze_space(application.actions[0]), XR_SUCCESS);
    ASSERT_EQ(application.make_reference_space(XR_REFERENCE_SPACE_TYPE_VIEW), XR_SUCCESS);
    ASSERT_EQ(application.make_reference_space(XR_REFERENCE_SPACE_TYPE_LOCAL), XR_SUCCESS);
    ASSERT_EQ(application.sync(), XR_SUCCESS);
    ASSERT_EQ(application.sync(), XR_SUCCESS);
}

}  // namespace gazeloop::openxr_layer
