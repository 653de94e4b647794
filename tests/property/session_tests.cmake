gazeloop_test(property_session
    SOURCES session_property_test.cpp
    LINK gazeloop::session
    LABELS property)
