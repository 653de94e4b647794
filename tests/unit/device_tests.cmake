gazeloop_test(unit_device
    SOURCES drivers/device/device_feed_test.cpp drivers/device/sample_clock_test.cpp
            drivers/device/usb_polling_test.cpp
    LINK gazeloop::device
    LABELS unit)
