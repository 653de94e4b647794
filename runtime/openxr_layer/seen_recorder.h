#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "runtime/frame/frame_record.h"
#include "runtime/gaze/gaze_to_fovea.h"
#include "runtime/openxr_layer/seen_frame.h"
#include "runtime/periodic_thread.h"
#include "runtime/session/session_recorder.h"
#include "runtime/spsc_queue.h"

namespace gazeloop::openxr_layer {

/// Makes a session of what is seen of an application's frames, on a thread of its own: a call of
/// the application's leaves what it saw in a queue, and wakes nobody.
class SeenRecorder {
  public:
    /// Errors: as SessionRecorder::create().
    static Expected<std::unique_ptr<SeenRecorder>> open(const std::filesystem::path& file,
                                                        const session::SessionHeader& header,
                                                        const gaze::FoveaPolicy& policy);
    SeenRecorder(const SeenRecorder&) = delete;
    SeenRecorder& operator=(const SeenRecorder&) = delete;
    /// Writes what is left, and says in the log what was lost.
    ~SeenRecorder();

    /// One thread at a time. Where the queue is full, which is for seconds, it is lost and counted.
    void add(const Seen& seen) {
        if (!queue_.try_push(seen)) {
            lost_.fetch_add(1, std::memory_order_relaxed);
        }
    }

  private:
    struct Placed {
        std::int64_t time_ns;
        gaze::Pose head;
    };

    SeenRecorder(std::filesystem::path file, std::unique_ptr<session::SessionRecorder> recorder,
                 const gaze::FoveaPolicy& policy);
    void record_all();
    void tell_trouble();
    void record(const SeenFrame& seen);
    void record(const SeenHead& seen);
    void record(const ArrivedSample& seen);
    void record(const CompositedFrame& seen);
    void record(const SaidEvent& seen);

    std::filesystem::path file_;
    std::unique_ptr<session::SessionRecorder> recorder_;
    SpscQueue<Seen> queue_;
    std::atomic<std::uint64_t> lost_{0};
    bool trouble_told_ = false;

    gaze::GazeToFovea gaze_;
    std::optional<std::int64_t> first_display_ns_;
    std::optional<Placed> head_;
    std::optional<Placed> head_before_;

    std::optional<PeriodicThread> thread_;  // the first to end
};

}  // namespace gazeloop::openxr_layer
