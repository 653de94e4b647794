#pragma once

#include <spdlog/spdlog.h>

#include <string_view>

#include "runtime/frame/frame_observer.h"
#include "runtime/session/session_recorder.h"

namespace gazeloop::run {

/// Passes everything on to the session's recorder. Warns at once when recording is in trouble.
class RecordingObserver final : public frame::FrameObserver {
  public:
    /// `then`: what comes of trouble, "the run goes on".
    explicit RecordingObserver(session::SessionRecorder& recorder,
                               std::string_view then = "the run goes on")
        : recorder_(recorder), then_(then) {}
    void on_sample(const gaze::GazeSample& sample, std::uint64_t frame) override {
        recorder_.add(sample, frame);
    }
    void on_hidden(const gaze::HiddenChange& change) override { recorder_.add(change); }
    void on_origin(const gaze::OriginChange& change) override { recorder_.add(change); }
    void on_frame(const frame::FrameRecord& record) override {
        recorder_.add(record);
        if (!trouble_reported_ && recorder_.in_trouble()) {
            trouble_reported_ = true;
            spdlog::warn("{}; {}", recorder_.trouble(), then_);
        }
    }
    void on_gpu(const frame::FrameGpuRecord& record) override { recorder_.add(record); }
    void on_event(time::Stamp time, std::string_view kind, std::string_view text) override {
        recorder_.event(time, kind, text);
    }

  private:
    session::SessionRecorder& recorder_;
    std::string_view then_;
    bool trouble_reported_ = false;
};

}  // namespace gazeloop::run
