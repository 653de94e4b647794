gazeloop_test(unit_doctor
    SOURCES doctor/host_checks_test.cpp doctor/probe_test.cpp
    LINK gazeloop::doctor
    LABELS unit)
gazeloop_test(unit_preview
    SOURCES preview/stage_bars_test.cpp
    LINK gazeloop::preview gazeloop::report
    LABELS unit)
