gazeloop_test(unit_gaze
    SOURCES gaze/combined_gaze_test.cpp gaze/view_test.cpp gaze/head_track_test.cpp
        gaze/fixation_test.cpp gaze/gaze_to_fovea_test.cpp gaze/vergence_test.cpp
    LINK gazeloop::gaze
    LABELS unit)
gazeloop_test(unit_drivers
    SOURCES drivers/read_trace_test.cpp drivers/htc_vive_pro_test.cpp
        drivers/native_trace_test.cpp drivers/trace_source_test.cpp drivers/fixed_source_test.cpp
    LINK gazeloop::trace gazeloop::fixed
    LABELS unit)
gazeloop_test(unit_sim
    SOURCES sim/eye_tracker_test.cpp sim/gaze_generator_test.cpp sim/person_test.cpp
        sim/random_test.cpp sim/recorded_head_test.cpp sim/saccade_test.cpp
        sim/virtual_tracker_test.cpp drivers/simulated_source_test.cpp
        ../support/allocation_counter.cpp
    LINK gazeloop::sim gazeloop::trace gazeloop::simulated gazeloop::uhid gazeloop::hid_reports
    LABELS unit)
# The simulation once more, on random numbers that are counted.
get_target_property(person_sources gazeloop_person SOURCES)
list(TRANSFORM person_sources PREPEND ${PROJECT_SOURCE_DIR}/sim/)
gazeloop_test(unit_sim_draws
    SOURCES sim/draws_test.cpp ${person_sources}
    LINK gazeloop::gaze
    LABELS unit)
target_include_directories(unit_sim_draws BEFORE PRIVATE
    ${PROJECT_SOURCE_DIR}/tests/support/counting_random)
target_compile_definitions(unit_sim_draws PRIVATE
    GAZELOOP_UNCOUNTED_RANDOM="${PROJECT_SOURCE_DIR}/sim/random.h")
gazeloop_test(unit_display_profile
    SOURCES display/display_profile_test.cpp
    LINK gazeloop::display
    LABELS unit)
