gazeloop_test(unit_foveation
    SOURCES foveation/hidden_area_test.cpp foveation/log_polar_map_test.cpp
        foveation/map_tables_test.cpp foveation/sampling_plan_test.cpp
        foveation/screen_wedge_test.cpp
    LINK gazeloop::foveation
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
