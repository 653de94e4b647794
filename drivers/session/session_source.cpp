#include "drivers/session/session_source.h"

#include <fmt/core.h>

namespace gazeloop::drivers {

SessionSource::SessionSource(const session::OpenSession& session, std::uint64_t sample_count)
    : file_(session.file().string()),
      sample_count_(sample_count),
      samples_(session),
      frames_(session) {
    next();
}

/// Leaves out samples whose frame the session lacks.
void SessionSource::next() {
    do {
        more_ = value_or_throw(samples_.next());
    } while (more_ && !value_or_throw(session::move_to(frames_, samples_.row()->frame)));
}

void SessionSource::poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) {
    while (more_ && frames_.row()->frame.stamps.latch.ns <= now_ns) {
        samples.push_back(samples_.row()->sample);
        next();
    }
}

std::string SessionSource::description() const {
    return fmt::format("session {} ({} samples)", file_, sample_count_);
}

}  // namespace gazeloop::drivers
