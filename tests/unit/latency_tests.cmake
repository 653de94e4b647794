gazeloop_test(unit_latency
    SOURCES time/clock_fit_test.cpp latency/duration_histogram_test.cpp latency/gaze_age_test.cpp
        latency/latency_summary_test.cpp latency/sample_counter_test.cpp
        report/summary_text_test.cpp time/tick_counter_test.cpp
        time/polled_clock_test.cpp time/timestamp_ticks_test.cpp
        ../support/allocation_counter.cpp
    LINK gazeloop::latency gazeloop::report
    LABELS unit)
