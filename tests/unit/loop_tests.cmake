gazeloop_test(unit_loop VULKAN
    SOURCES loop/frame_timeline_test.cpp loop/spsc_queue_test.cpp
    LINK gazeloop::frame_loop
    LABELS unit)
