gazeloop_test(unit_hid
    SOURCES drivers/hid/report_descriptor_test.cpp drivers/hid/report_value_test.cpp
        drivers/hid/eye_tracker_test.cpp drivers/hid/tracker_samples_test.cpp
        ../support/allocation_counter.cpp
    LINK gazeloop::hid_reports
    LABELS unit)
