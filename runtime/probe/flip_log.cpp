#include "runtime/probe/flip_log.h"

#include <algorithm>

#include "runtime/latency/gaze_age.h"

namespace gazeloop::probe {

time::Span Loss::lasted() const {
    if (!found) {
        return {};
    }
    const time::Span by_samples = time::between(lost.sampled, found->sampled);
    return by_samples.known() ? by_samples : time::between(lost.latched, found->latched);
}

void FlipLog::add(const Flip& flip) {
    if (flips_.size() == kMost) {
        ++not_kept_;
        return;
    }
    flips_.push_back(flip);
    if (!flip.lost) {
        const Loss loss{.lost = flips_[flips_.size() - 2], .found = flip};
        const time::Span lasted = loss.lasted();
        lamp_flashes_ += lasted.known() && lasted.ns >= kLeastLamp_ns ? 1 : 0;
    }
}

void FlipLog::set_shown(std::uint64_t index, const time::Stamp& gpu_end) {
    // The GPU is a few frames behind at most.
    for (auto flip = flips_.rbegin(); flip != flips_.rend() && flip->frame >= index; ++flip) {
        if (flip->frame == index) {
            frame::FrameStamps stamps;
            stamps.gpu_end = gpu_end;
            stamps.display = flip->display;
            flip->shown = latency::shown_frame(stamps, flip->period_ns).at;
        }
    }
}

std::vector<Loss> FlipLog::losses() const {
    std::vector<Loss> losses;
    for (const Flip& flip : flips_) {
        if (flip.lost) {
            losses.push_back({.lost = flip});
        } else {
            losses.back().found = flip;
        }
    }
    return losses;
}

}  // namespace gazeloop::probe
