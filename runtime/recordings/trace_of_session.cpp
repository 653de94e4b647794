#include "runtime/recordings/trace_of_session.h"

#include <fmt/core.h>

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "runtime/memory/spool.h"
#include "runtime/session/playback.h"

namespace gazeloop::recordings {
namespace {

class SpooledSamples final : public gaze::SampleSource {
  public:
    void add(const gaze::GazeSample& sample) { samples_.add(sample); }
    [[nodiscard]] std::size_t size() const override { return samples_.size(); }
    void read(std::size_t first, std::span<gaze::GazeSample> to) const override {
        samples_.read(first, to);
    }

  private:
    memory::Spool<gaze::GazeSample> samples_;
};

/// Makes a session's gaze a trace, in the order in which it arrived, the first of it at 0. What has
/// no known time keeps none: losses, and what came before the tracker's clock was known.
class TraceOfSession final : public frame::FrameObserver {
  public:
    explicit TraceOfSession(const std::string& file) {
        trace_.file = file;
        trace_.format = kSessionFormat;
        trace_.device = "recorded session";
    }

    void on_sample(const gaze::GazeSample& recorded, std::uint64_t) override {
        gaze::GazeSample sample = recorded;
        if (!start_) {
            start_ = recorded.arrived.known() ? recorded.arrived : recorded.sampled;
        }
        for (time::Stamp* const stamp : {&sample.sampled, &sample.ready, &sample.arrived}) {
            // Eleven days; --speed may stretch them a thousandfold.
            constexpr std::int64_t kLongest_ns = 1'000'000'000'000'000;
            std::int64_t since_start_ns = 0;
            if (__builtin_sub_overflow(stamp->ns, start_->ns, &since_start_ns) ||
                since_start_ns < -kLongest_ns || since_start_ns > kLongest_ns) {
                stamp->kind = time::StampKind::Unknown;
            }
            *stamp = stamp->known() ? time::Stamp{since_start_ns, stamp->kind} : time::Stamp{};
        }
        samples_->add(sample);
    }

    /// `missing_log` as SessionInfo has it.
    gaze::GazeRecording take(const std::string& missing_log) {
        if (samples_->size() == 0) {
            throw SetupError(ErrorKind::BadInput,
                             fmt::format("{}: the session holds no gaze{}{}", trace_.file,
                                         missing_log.empty() ? " to replay" : ": ", missing_log));
        }
        trace_.samples = std::move(samples_);
        return std::move(trace_);
    }

  private:
    gaze::GazeRecording trace_;
    std::shared_ptr<SpooledSamples> samples_ = std::make_shared<SpooledSamples>();
    std::optional<time::Stamp> start_;
};

}  // namespace

gaze::GazeRecording trace_of_session(const session::OpenSession& session) {
    TraceOfSession trace(session.file().string());
    const std::array<frame::FrameObserver*, 1> observers{&trace};
    value_or_throw(session::play(session, observers));
    return trace.take(session.info().missing_log);
}

}  // namespace gazeloop::recordings
