gazeloop_test(unit_gaze
    SOURCES gaze/view_test.cpp gaze/head_track_test.cpp gaze/gaze_to_fovea_test.cpp
    LINK gazeloop::gaze
    LABELS unit)
gazeloop_test(unit_drivers
    SOURCES drivers/read_trace_test.cpp drivers/htc_vive_pro_test.cpp
        drivers/native_trace_test.cpp drivers/trace_source_test.cpp drivers/fixed_source_test.cpp
    LINK gazeloop::trace gazeloop::fixed
    LABELS unit)
gazeloop_test(unit_sim
    SOURCES sim/gaze_generator_test.cpp
    LINK gazeloop::sim gazeloop::trace
    LABELS unit)
