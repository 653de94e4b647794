gazeloop_test(unit_session
    SOURCES session/fixed_text_test.cpp session/session_file_test.cpp
        session/session_recorder_test.cpp
        ../support/allocation_counter.cpp
    LINK gazeloop::session
    LABELS unit)
# Alone, because it asks how late a thread may be.
gazeloop_test(unit_session_kill
    SOURCES session/session_kill_test.cpp
    LINK gazeloop::session
    LABELS unit
    SERIAL)
