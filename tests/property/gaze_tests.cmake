gazeloop_test(property_gaze
    SOURCES gaze_property_test.cpp simulated_gaze_property_test.cpp trace_property_test.cpp
    LINK gazeloop::gaze gazeloop::trace gazeloop::simulated gazeloop::sim
    LABELS property)
