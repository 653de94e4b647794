gazeloop_test(property_sampling_plans
    SOURCES sampling_plans_property_test.cpp
    LINK gazeloop::foveation
    LABELS property)
