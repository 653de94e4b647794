gazeloop_test(unit_foveation
    SOURCES foveation/log_polar/acuity_map_test.cpp foveation/picture/hidden_area_test.cpp
        foveation/log_polar/log_polar_map_test.cpp foveation/log_polar/map_tables_test.cpp
        foveation/log_polar/map_traps_test.cpp foveation/log_polar/mpfr_test.cpp foveation/log_polar/radial_kernel_test.cpp
        foveation/plans/sampling_plan_test.cpp foveation/picture/screen_wedge_test.cpp
        foveation/picture/shaded_around_test.cpp
    LINK gazeloop::foveation gazeloop::methods mpfr
    LABELS unit)
gazeloop_test(unit_sampling_demand
    SOURCES foveation/eye/acuity_model_test.cpp foveation/eye/fewest_samples_test.cpp
        foveation/eye/fovea_widening_test.cpp foveation/picture/gaze_field_test.cpp
        foveation/eye/sufficiency_test.cpp
    LINK gazeloop::foveation
    LABELS unit)
gazeloop_test(unit_sampling_plans
    SOURCES foveation/plans/eccentricity_layers_test.cpp foveation/plans/layer_plan_test.cpp
        foveation/plans/nearest_samples_test.cpp foveation/plans/shading_rings_test.cpp
        foveation/plans/sparse_pattern_test.cpp
    LINK gazeloop::foveation
    LABELS unit)
# g++ 12 sees the kernel's variant uninitialised where the cases are copied (GCC PR105562's kind).
set_source_files_properties(foveation/plans/sampling_plan_test.cpp PROPERTIES
    COMPILE_OPTIONS $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
