#include "runtime/run/governed_frames.h"

#include <fmt/core.h>

#include "runtime/frame/event.h"

namespace gazeloop::run {

GovernedFrames::GovernedFrames(const governor::GovernorSettings& settings,
                               const governor::GovernorOptions& options, std::size_t levels,
                               bool replay)
    : settings_(settings), options_(options), levels_(levels), replay_(replay) {}

void GovernedFrames::set_renderers(std::vector<std::unique_ptr<render::FrameRenderer>> renderers,
                                   std::span<const double> ms) {
    renderers_ = std::move(renderers);
    for (const auto& renderer : renderers_) {
        lists_.add(*renderer);
    }
    if (!replay_) {
        governor_.emplace(options_, ms);
    }
}

std::size_t GovernedFrames::recorded_level(const render::FrameToChoose& frame) const {
    if (!frame.recorded_level || *frame.recorded_level >= levels_) {
        throw SetupError(
            ErrorKind::BadInput,
            fmt::format("frame {}: its quality level is {}, of {}: the recording is damaged; "
                        "replay its gaze with --clock wall instead",
                        frame.index,
                        frame.recorded_level ? fmt::format("{}", *frame.recorded_level) : "missing",
                        levels_));
    }
    return *frame.recorded_level;
}

render::FrameRenderer* GovernedFrames::choose(const render::FrameToChoose& frame) {
    if (replay_) {
        level_ = static_cast<std::uint8_t>(recorded_level(frame));
    } else {
        if (auto decided = governor_->next(eyes_, settings_.budget_of(frame.period_ns))) {
            decision_ = decided;
        }
        level_ = static_cast<std::uint8_t>(governor_->level());
    }
    level_of_[frame.index % kUnderWay] = *level_;
    return renderers_[*level_].get();
}

std::optional<render::ChooserEvent> GovernedFrames::take_event() {
    if (!decision_) {
        return std::nullopt;
    }
    const governor::Decision decision = *decision_;
    decision_.reset();
    return render::ChooserEvent{decision.reason == governor::Reason::Held
                                    ? frame::kQualityFloorEvent
                                    : frame::kQualityLevelEvent,
                                governor::decision_text(decision)};
}

void GovernedFrames::on_frame(const frame::FrameRecord& record) {
    eyes_ = governor::seen_eyes(record.fovea);
}

void GovernedFrames::on_gpu(const frame::FrameGpuRecord& record) {
    if (governor_ && record.gpu_begin.known() && record.gpu_end.known()) {
        constexpr double kNsPerMs = 1e6;
        governor_->measured(
            level_of_[record.index % kUnderWay],
            static_cast<double>(record.gpu_end.ns - record.gpu_begin.ns) / kNsPerMs);
    }
}

}  // namespace gazeloop::run
