#include "runtime/report/runtime_metrics/monado_frames.h"

#include <functional>
#include <utility>

#include "runtime/time/span.h"

namespace gazeloop::report {
namespace {

/// A present is within this of when the compositor wanted it; else it is of another clock, or no
/// time at all.
constexpr std::int64_t kFarthestPresentNs = 10'000'000'000;

/// Positive, as the difference of two times in any order.
__int128 apart(std::int64_t a, std::int64_t b) {
    const __int128 difference = static_cast<__int128>(a) - b;
    return difference < 0 ? -difference : difference;
}

}  // namespace

std::size_t MonadoFrames::HashOfId::operator()(const AppFrameId& id) const {
    constexpr std::size_t kSpread = 0x9E37'79B9'7F4A'7C15;  // 2^64 over the golden ratio
    return std::hash<std::int64_t>{}(id.session) * kSpread ^ std::hash<std::int64_t>{}(id.frame);
}

MonadoFrames::MonadoFrames(MonadoMetricsReader file)
    : file_(std::move(file)), system_frames_(kKept) {
    frames_.reserve(kKept);
}

void MonadoFrames::read_until(std::int64_t until_ns) {
    constexpr int kEnough = 16;  // records in a row that lie behind it
    int behind = last_ns_ && *last_ns_ > until_ns ? kEnough : 0;
    while (!at_end_ && behind < kEnough) {
        const auto record = file_.next();
        at_end_ = !record.has_value();
        const std::int64_t time_ns = record ? take(*record) : 0;
        if (time_ns <= 0) {
            continue;
        }
        first_ns_ = first_ns_.value_or(time_ns);
        last_ns_ = time_ns;
        behind = time_ns > until_ns ? behind + 1 : 0;
    }
}

std::int64_t MonadoFrames::take(const MonadoRecord& record) {
    if (const auto* const frame = std::get_if<MonadoSessionFrame>(&record)) {
        take(*frame);
        return frame->gpu_done_ns;
    }
    if (const auto* const used = std::get_if<MonadoUsed>(&record)) {
        take(*used);
        return used->when_ns;
    }
    if (const auto* const planned = std::get_if<MonadoSystemFrame>(&record)) {
        if (SystemFrame* const frame = system_frame(planned->frame)) {
            *frame = {.frame = planned->frame,
                      .predicted_display_ns = planned->predicted_display_ns,
                      .desired_present_ns = planned->desired_present_ns};
        }
        return 0;  // its times are yet to come
    }
    if (const auto* const gpu = std::get_if<MonadoGpuInfo>(&record)) {
        if (SystemFrame* const frame = system_frame(gpu->frame)) {
            frame->gpu_end_ns = gpu->gpu_end_ns;
        }
        return gpu->when_ns;
    }
    if (const auto* const info = std::get_if<MonadoPresentInfo>(&record)) {
        if (SystemFrame* const frame = system_frame(info->frame)) {
            frame->predicted_display_ns = info->predicted_display_ns;
            frame->desired_present_ns = info->desired_present_ns;
            frame->actual_present_ns = info->actual_present_ns;
        }
        return info->when_ns;
    }
    return 0;
}

void MonadoFrames::take(const MonadoSessionFrame& told) {
    const AppFrame frame{.session = told.session,
                         .frame = told.frame,
                         .display_ns = told.predicted_display_ns,
                         .begin_ns = told.begin_ns,
                         .discarded = told.discarded};
    std::size_t place = frames_.size();
    if (place < kKept) {
        frames_.push_back(frame);
    } else {
        place = std::exchange(oldest_, (oldest_ + 1) % kKept);
        const AppFrame& old = frames_[place];
        const auto [first, last] = by_display_.equal_range(old.display_ns);
        for (auto at = first; at != last; ++at) {
            if (at->second == place) {
                by_display_.erase(at);
                break;
            }
        }
        const auto id = by_id_.find({old.session, old.frame});
        if (id != by_id_.end() && id->second == place) {
            by_id_.erase(id);
        }
        frames_[place] = frame;
    }
    by_display_.emplace(frame.display_ns, place);
    by_id_.insert_or_assign({frame.session, frame.frame}, place);
}

void MonadoFrames::take(const MonadoUsed& used) {
    const auto at = by_id_.find({used.session, used.session_frame});
    if (at == by_id_.end()) {
        return;
    }
    AppFrame& frame = frames_[at->second];
    if (frame.times++ == 0) {
        frame.system_frame = used.system_frame;
    }
}

MonadoFrames::SystemFrame* MonadoFrames::system_frame(std::int64_t frame) {
    if (frame < 0) {
        return nullptr;
    }
    SystemFrame& place = system_frames_[static_cast<std::size_t>(frame) % kKept];
    if (place.frame != frame) {
        place = {.frame = frame};
    }
    return &place;
}

MonadoShown MonadoFrames::find(std::int64_t display_ns, std::int64_t begin_ns) const {
    const auto [first, last] = by_display_.equal_range(display_ns);
    const auto* nearest = first == last ? nullptr : &*first;
    for (auto at = first; at != last; ++at) {
        if (apart(frames_[at->second].begin_ns, begin_ns) <
            apart(frames_[nearest->second].begin_ns, begin_ns)) {
            nearest = &*at;
        }
    }
    if (nearest == nullptr) {
        return {.fate = MonadoFate::Missing};
    }
    const AppFrame& frame = frames_[nearest->second];
    if (frame.discarded) {
        return {.fate = MonadoFate::Discarded};
    }
    if (frame.times > 0) {
        return shown(frame);
    }
    return {.fate = later_one_taken(nearest->second) ? MonadoFate::Replaced : MonadoFate::NotTaken};
}

MonadoShown MonadoFrames::shown(const AppFrame& frame) const {
    const MonadoShown untimed{.fate = MonadoFate::Untimed, .times = frame.times};
    if (frame.system_frame < 0) {
        return untimed;
    }
    const SystemFrame& by = system_frames_[static_cast<std::size_t>(frame.system_frame) % kKept];
    if (by.frame != frame.system_frame || by.desired_present_ns <= 0 ||
        by.predicted_display_ns <= 0 ||
        apart(by.predicted_display_ns, by.desired_present_ns) > kFarthestPresentNs) {
        return untimed;
    }
    const bool measured = by.actual_present_ns > 0;
    const std::int64_t present_ns = measured ? by.actual_present_ns : by.desired_present_ns;
    if (apart(present_ns, by.desired_present_ns) > kFarthestPresentNs) {
        return untimed;
    }
    const __int128 display_ns =
        static_cast<__int128>(present_ns) + by.predicted_display_ns - by.desired_present_ns;
    const auto kind = [measured](time::StampKind then) {
        return measured ? then : time::StampKind::Modelled;
    };
    return {.fate = measured ? MonadoFate::Presented : MonadoFate::Modelled,
            .present = {present_ns, kind(time::StampKind::Measured)},
            .shown = {time::saturated(display_ns), kind(time::StampKind::Profile)},
            .times = frame.times,
            .compositor_late = by.gpu_end_ns > present_ns};
}

bool MonadoFrames::later_one_taken(std::size_t place) const {
    const AppFrame& frame = frames_[place];
    for (std::size_t at = (place + 1) % frames_.size(); at != oldest_;
         at = (at + 1) % frames_.size()) {
        const AppFrame& later = frames_[at];
        if (later.session == frame.session && later.times > 0) {
            return true;
        }
    }
    return false;
}

}  // namespace gazeloop::report
