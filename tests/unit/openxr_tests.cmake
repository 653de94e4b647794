gazeloop_test(unit_openxr_gaze
    SOURCES drivers/openxr/gaze_gates_test.cpp drivers/openxr/gaze_reader_test.cpp
        drivers/openxr/sample_time_test.cpp
    LINK gazeloop::openxr_gaze_reader
    LABELS unit)
gazeloop_test(unit_announced_time
    SOURCES present/announced_time_test.cpp
    LINK gazeloop::announced_time
    LABELS unit)
gazeloop_test(unit_scaled_extent
    SOURCES present/scaled_extent_test.cpp
    LINK gazeloop::present
    LABELS unit)
