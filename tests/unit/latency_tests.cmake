gazeloop_test(unit_latency
    SOURCES latency/clock_fit_test.cpp latency/duration_histogram_test.cpp latency/gaze_age_test.cpp
        latency/latency_summary_test.cpp latency/sample_counter_test.cpp
        latency/summary_text_test.cpp latency/tick_counter_test.cpp
        latency/polled_clock_test.cpp latency/timestamp_ticks_test.cpp
        ../support/allocation_counter.cpp
    LINK gazeloop::latency
    LABELS unit)
