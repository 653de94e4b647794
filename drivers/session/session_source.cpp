#include "drivers/session/session_source.h"

#include <fmt/core.h>

#include <utility>

namespace gazeloop::drivers {

SessionSource::SessionSource(std::string file, std::vector<Sample> samples)
    : file_(std::move(file)), samples_(std::move(samples)) {}

void SessionSource::poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) {
    while (!finished() && samples_[next_].consumed_ns <= now_ns) {
        samples.push_back(samples_[next_++].sample);
    }
}

std::string SessionSource::description() const {
    return fmt::format("session {} ({} samples)", file_, samples_.size());
}

}  // namespace gazeloop::drivers
