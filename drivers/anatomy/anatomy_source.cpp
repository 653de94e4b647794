#include "drivers/anatomy/anatomy_source.h"

#include <fmt/format.h>

#include <utility>

namespace gazeloop::drivers {
namespace {

SourceEvent event_of(const gaze::Anatomy& anatomy, const time::Stamp& when) {
    const std::string text = gaze::anatomy_text(anatomy);
    if (!anatomy.doubtful()) {
        return {.time = when, .text = fmt::format("directions: {}", text)};
    }
    return {.time = when,
            .text = fmt::format("{}; calibrate the tracker anew, or correct its driver's axes: "
                                "gaze is used as it comes",
                                text),
            .kind = frame::kAxesEvent};
}

}  // namespace

AnatomySource::AnatomySource(std::unique_ptr<GazeSource> source)
    : source_(std::move(source)), check_(std::in_place, kDecide) {}

void AnatomySource::poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) {
    const std::size_t before = samples.size();
    source_->poll(now_ns, samples);
    for (std::size_t i = before; check_ && i < samples.size(); ++i) {
        check_->add(samples[i]);
        if (check_->pairs() >= kDecide || check_->samples() >= 3 * kDecide) {
            found_ = event_of(check_->judge(), samples[i].arrived);
            check_.reset();
        }
    }
}

std::vector<SourceEvent> AnatomySource::take_events() {
    std::vector<SourceEvent> events = source_->take_events();
    if (found_) {
        events.push_back(*std::exchange(found_, std::nullopt));
    }
    return events;
}

}  // namespace gazeloop::drivers
