gazeloop_test(property_latency
    SOURCES duration_histogram_property_test.cpp gaze_age_property_test.cpp
    LINK gazeloop::latency
    LABELS property)
