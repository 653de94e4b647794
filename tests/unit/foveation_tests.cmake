gazeloop_test(unit_foveation
    SOURCES foveation/acuity_map_test.cpp foveation/hidden_area_test.cpp
        foveation/log_polar_map_test.cpp foveation/map_tables_test.cpp
        foveation/map_traps_test.cpp foveation/mpfr_test.cpp foveation/radial_kernel_test.cpp
        foveation/sampling_plan_test.cpp foveation/screen_wedge_test.cpp
        foveation/shaded_around_test.cpp
    LINK gazeloop::foveation mpfr
    LABELS unit)
gazeloop_test(unit_sampling_demand
    SOURCES foveation/acuity_model_test.cpp foveation/fewest_samples_test.cpp
        foveation/fovea_widening_test.cpp foveation/gaze_field_test.cpp
        foveation/sufficiency_test.cpp
    LINK gazeloop::foveation
    LABELS unit)
gazeloop_test(unit_sampling_plans
    SOURCES foveation/eccentricity_layers_test.cpp foveation/layer_plan_test.cpp
        foveation/nearest_samples_test.cpp foveation/shading_rings_test.cpp
        foveation/sparse_pattern_test.cpp
    LINK gazeloop::foveation
    LABELS unit)
# g++ 12 sees the kernel's variant uninitialised where the cases are copied (GCC PR105562's kind).
set_source_files_properties(foveation/sampling_plan_test.cpp PROPERTIES
    COMPILE_OPTIONS $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
