gazeloop_test(unit_profiles
    SOURCES profiles/profiles_test.cpp
    LINK gazeloop_test_support gazeloop::profiles
    LABELS unit)
