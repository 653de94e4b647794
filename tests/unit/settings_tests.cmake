gazeloop_test(unit_profiles
    SOURCES settings/profiles_test.cpp
    LINK gazeloop_test_support gazeloop::settings
    LABELS unit)
