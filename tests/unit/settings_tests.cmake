gazeloop_test(unit_settings
    SOURCES settings/settings_test.cpp
    LINK gazeloop_test_support gazeloop::settings
    LABELS unit)
gazeloop_test(unit_profiles
    SOURCES profiles/profiles_test.cpp
    LINK gazeloop_test_support gazeloop::profiles
    LABELS unit)
gazeloop_test(unit_program_settings VULKAN
    SOURCES run/program_settings_test.cpp
    LINK gazeloop::run
    LABELS unit)
