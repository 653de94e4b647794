#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>

#include "runtime/openxr_layer/gaze_history.h"
#include "runtime/openxr_layer/seen_recorder.h"

namespace gazeloop::openxr_layer {

/// What is seen of an application's frames at the API, to be written as a session. Its calls may
/// come from several threads, and a frame be waited for before the one before it has ended. Nothing
/// is allocated after construction, nor computed that the recorder's thread can compute.
///
/// A frame's latch is the last time that the application read the gaze for it; where it reads none,
/// when it asked for its views, which is the last moment at which anybody could have aimed its
/// picture. What its GPU did is not known.
class FrameTap {
  public:
    /// Errors: as SessionRecorder::create(). The destructor writes what is left.
    static Expected<std::unique_ptr<FrameTap>> open(const std::filesystem::path& file,
                                                    const session::SessionHeader& header,
                                                    const gaze::FoveaPolicy& policy);

    struct Announced {
        std::optional<std::int64_t> display_ns;  ///< host time; none: not known
        std::int64_t period_ns = 0;
        bool should_render = true;
    };

    // As the application does them. Times are host time. `key`: the frame's predicted display time
    // as the runtime gave it.

    void waited(std::int64_t key, std::int64_t now_ns, const Announced& announced);
    void begun(std::int64_t now_ns);
    /// Views in a space that stands still, for the display time `key`. Sizes are ignored.
    void located(std::int64_t key, std::int64_t now_ns, const gaze::StereoView& views);
    void read_gaze(std::int64_t now_ns);
    /// Whether nobody has asked for the views of the frame with that display time.
    [[nodiscard]] bool lacks_views(std::int64_t key);
    /// The frame was handed over between two times.
    void ended(std::int64_t key, std::int64_t before_ns, std::int64_t now_ns,
               const FramePictures& pictures);

    /// The samples that came since the last call; `head_at` gives the head in the views' space at a
    /// host time, where it is known, and is asked for the newest only.
    template <typename HeadAt>
    void take(const GazeHistory& history, HeadAt&& head_at) {
        const std::lock_guard lock(mutex_);
        const std::uint64_t from = std::max(taken_, history.first());
        taken_ = history.count();
        if (from == taken_) {
            return;
        }
        const SeenGaze& newest = history[taken_ - 1];
        recorder_->add(SeenHead{newest.time_ns, newest.sample.sampled.known()
                                                    ? head_at(newest.time_ns)
                                                    : std::nullopt});
        for (std::uint64_t number = from; number < taken_; ++number) {
            const SeenGaze& seen = history[number];
            recorder_->add(ArrivedSample{.sample = seen.sample,
                                         .time_ns = seen.time_ns,
                                         .frame = index_,
                                         .newest = number + 1 == taken_});
        }
    }

    /// The number that the next frame to be handed over gets.
    [[nodiscard]] std::uint64_t next_index();
    /// How long the GPU took to composite a frame: the run's first pass.
    void composited(std::uint64_t index, std::int64_t gpu_ns);

    void event(std::string_view kind, std::string_view text);

  private:
    struct Frame {
        std::int64_t key = 0;
        bool waited = false;
        bool gaze_read = false;
        SeenFrame seen;
    };

    explicit FrameTap(std::unique_ptr<SeenRecorder> recorder) : recorder_(std::move(recorder)) {}
    [[nodiscard]] Frame* frame_of(std::int64_t key);

    /// More frames are not waited for at a time by any application of sense.
    static constexpr std::size_t kMostFrames = 4;

    std::mutex mutex_;
    std::unique_ptr<SeenRecorder> recorder_;
    std::array<Frame, kMostFrames> frames_;  ///< by the order of waiting, modulo size
    std::uint64_t waited_ = 0;
    std::uint64_t begun_ = 0;
    std::uint64_t index_ = 0;
    std::uint64_t taken_ = 0;
};

}  // namespace gazeloop::openxr_layer
