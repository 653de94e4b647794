#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <variant>
#include <vector>

#include "runtime/frame/frame_observer.h"
#include "runtime/session/recorded_rows.h"

namespace gazeloop::session {

/// What a session's reader tells, in the order in which it does.
using Told = std::variant<gaze::HiddenChange, gaze::OriginChange, RecordedSample, RecordedEvent,
                          frame::FrameRecord, frame::FrameGpuRecord, frame::FrameGaze>;

/// Hands batches of it from the thread that reads to the one that is told. In memory that no length
/// changes: the reader waits where it is ahead by more.
class ReadAhead {
  public:
    using Batch = std::vector<Told>;
    static constexpr std::size_t kBatch = 256;
    static constexpr std::size_t kMostBatches = 8;

    // The reader's.

    /// Gives an empty batch back, whose memory is that of one before. False: nobody listens any
    /// more.
    bool give(Batch& batch);
    /// Nothing follows; `failure`: why the reader ended early, if it did.
    void end(std::exception_ptr failure);

    // The listener's.

    /// The next batch in exchange for the one before; false after the last one. Throws what the
    /// reader ended with.
    bool take(Batch& batch);
    /// Nothing more is taken.
    void stop();

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Batch> full_;
    std::vector<Batch> empty_;
    std::exception_ptr failure_;
    bool ended_ = false;
    bool stopped_ = false;
};

/// Tells an observer.
void tell(frame::FrameObserver& observer, const Told& told);

/// Passes on what it is told. Throws Stopped where nobody listens any more.
class ReadAheadObserver final : public frame::FrameObserver {
  public:
    struct Stopped {};

    explicit ReadAheadObserver(ReadAhead& ahead);
    void on_sample(const gaze::GazeSample& sample, std::uint64_t frame) override;
    void on_hidden(const gaze::HiddenChange& change) override { add(change); }
    void on_origin(const gaze::OriginChange& change) override { add(change); }
    void on_frame(const frame::FrameRecord& record) override { add(record); }
    void on_gpu(const frame::FrameGpuRecord& record) override { add(record); }
    void on_gaze(const frame::FrameGaze& gaze) override { add(gaze); }
    void on_event(time::Stamp time, std::string_view kind, std::string_view text) override;
    /// What is left.
    void flush();

  private:
    template <typename T>
    void add(T&& one) {
        batch_.emplace_back(std::forward<T>(one));
        if (batch_.size() == ReadAhead::kBatch) {
            flush();
        }
    }

    ReadAhead& ahead_;
    ReadAhead::Batch batch_;
};

}  // namespace gazeloop::session
