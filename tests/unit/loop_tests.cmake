gazeloop_test(unit_loop VULKAN
    SOURCES frame/passes_test.cpp render/temporal_test.cpp vulkan/memory_types_test.cpp loop/frame_timeline_test.cpp loop/spsc_queue_test.cpp
    LINK gazeloop::frame_loop
    LABELS unit)
