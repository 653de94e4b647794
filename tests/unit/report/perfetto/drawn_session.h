#pragma once

#include <string>
#include <utility>

#include "runtime/report/perfetto/perfetto_observer.h"
#include "tests/support/perfetto_trace.h"
#include "tests/unit/latency/example_frame.h"

namespace gazeloop::report::perfetto {

/// A session that is told to an observer, and read back from what that wrote.
class DrawnSession {
  public:
    explicit DrawnSession(PerfettoConfig config = {})
        : observer_(with_passes(std::move(config)),
                    [this](std::string_view bytes) { bytes_ += bytes; }) {}

    void add(const frame::FrameRecord& frame) { observer_.on_frame(frame); }
    void add(const frame::FrameGpuRecord& gpu) { observer_.on_gpu(gpu); }
    void add(const frame::FrameGaze& gaze) { observer_.on_gaze(gaze); }
    void add(const gaze::GazeSample& sample) { observer_.on_sample(sample, 0); }
    void add_event(const time::Stamp& time, std::string_view kind, std::string_view text) {
        observer_.on_event(time, kind, text);
    }
    /// Example frames, which last so long on the GPU.
    void add_examples(std::uint64_t first, std::uint64_t count, std::int64_t gpu_ms = 4) {
        for (std::uint64_t index = first; index < first + count; ++index) {
            add(latency::example_frame(index));
            add(latency::example_gpu(index, gpu_ms));
        }
    }
    tests::PerfettoTrace read() {
        observer_.finish();
        return tests::read_perfetto(bytes_);
    }
    [[nodiscard]] const PerfettoObserver& observer() const { return observer_; }
    [[nodiscard]] std::uint64_t unshown(Subject subject, WhyUnshown why) const {
        return observer_.unshown().count(subject, why);
    }

  private:
    static PerfettoConfig with_passes(PerfettoConfig config) {
        config.session.passes = latency::kExamplePasses;
        return config;
    }

    std::string bytes_;
    PerfettoObserver observer_;
};

}  // namespace gazeloop::report::perfetto
