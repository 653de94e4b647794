gazeloop_test(unit_psvr2
    SOURCES drivers/psvr2/gaze_packet_test.cpp drivers/psvr2/gaze_samples_test.cpp
        drivers/psvr2/head_axes_test.cpp ../support/allocation_counter.cpp
    LINK gazeloop::psvr2_packets gazeloop::sim rapidcheck_gtest
    LABELS unit)
