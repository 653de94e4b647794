#include "runtime/openxr_layer/gaze_feed.h"

#include <fmt/format.h>

#include <exception>
#include <utility>

#include "runtime/openxr_layer/layer_log.h"

namespace gazeloop::openxr_layer {
namespace {

constexpr std::size_t kSamplesAtOnce = 4096;
constexpr std::int64_t kTracks_ns = 1'000'000'000;

}  // namespace

GazeFeed::GazeFeed(std::string name, run::MakeSource make, const HistoryPolicy& policy)
    : name_(std::move(name)), make_(std::move(make)), history_(policy) {
    samples_.reserve(kSamplesAtOnce);
}

void GazeFeed::poll(std::int64_t now_ns) {
    if (failed_) {
        return;
    }
    samples_.clear();
    try {
        if (source_ != nullptr && source_->finished()) {
            source_.reset();
            sequence_offset_ =
                history_.count() > 0 ? history_[history_.count() - 1].sample.sequence + 1 : 0;
        }
        if (source_ == nullptr) {
            source_ = make_(now_ns);
            say(LogLevel::Info, fmt::format("gaze: {}", source_->description()));
        }
        source_->poll(now_ns, samples_);
        tell_events();
    } catch (const std::exception& error) {
        failed_ = true;
        say(LogLevel::Warning,
            fmt::format("the gaze source {} failed, there is no gaze from here on: {}", name_,
                        error.what()));
    } catch (...) {
        failed_ = true;
        say(LogLevel::Warning,
            fmt::format("the gaze source {} failed, there is no gaze from here on", name_));
    }
    for (gaze::GazeSample& sample : samples_) {
        sample.sequence += sequence_offset_;
        history_.add(sample);
        last_arrival_ns_ = now_ns;
    }
}

void GazeFeed::tell_events() {
    for (const drivers::SourceEvent& event : source_->take_events()) {
        say(LogLevel::Info, fmt::format("{}: {}", event.kind.name, event.text));
    }
}

bool GazeFeed::tracks(std::int64_t now_ns) {
    return take(now_ns, [&](const GazeHistory& history) {
        return history.count() > 0 && now_ns - last_arrival_ns_ <= kTracks_ns &&
               !history[history.count() - 1].sample.tracker_gone;
    });
}

}  // namespace gazeloop::openxr_layer
