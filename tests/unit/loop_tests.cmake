gazeloop_test(unit_loop
    SOURCES loop/frame_timeline_test.cpp loop/spsc_queue_test.cpp
    LINK gazeloop::frame_loop
    LABELS unit)
target_precompile_headers(unit_loop PRIVATE <vulkan/vulkan_raii.hpp>)
