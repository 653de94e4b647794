// A shared object of the libraries that an OpenXR API layer links: they must be position
// independent.
#include <cstdint>

#include "runtime/session/session_recorder.h"
#include "runtime/time/clock_fit.h"

extern "C" std::int64_t gazeloop_linked_as_module() {
    gazeloop::time::ClockFit fit;
    fit.add(1, 2);
    return gazeloop::session::SessionRecorder::check("/").has_value() ? fit.offset_ns() : 1;
}
