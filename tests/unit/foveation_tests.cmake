gazeloop_test(unit_foveation
    SOURCES foveation/log_polar_map_test.cpp foveation/map_tables_test.cpp
        foveation/sampling_plan_test.cpp foveation/screen_wedge_test.cpp
    LINK gazeloop::foveation
    LABELS unit)
