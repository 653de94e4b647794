#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "runtime/error.h"
#include "runtime/frame/frame_observer.h"

namespace gazeloop::run {

/// Looks through a recording before it is run again. Throws SetupError (BadInput) for what the
/// program cannot have recorded.
class ReplayableFrames final : public frame::FrameObserver {
  public:
    explicit ReplayableFrames(std::string file) : file_(std::move(file)) {}

    void on_sample(const gaze::GazeSample&, std::uint64_t) override { ++samples_told_; }
    void on_frame(const frame::FrameRecord& frame) override;

    /// Throws SetupError (BadInput) if there are none, or none that was to be drawn.
    [[nodiscard]] std::uint64_t frames() const;
    [[nodiscard]] std::uint64_t samples_consumed() const { return samples_consumed_; }
    /// Of the first frame that was to be drawn.
    [[nodiscard]] const gaze::StereoView& first_views() const { return first_views_; }

  private:
    [[nodiscard]] SetupError damaged(std::string_view what) const;
    void check_view(const frame::FrameRecord& frame, gaze::Eye eye) const;

    std::string file_;
    std::uint64_t frames_ = 0;
    std::uint64_t samples_told_ = 0;
    std::uint64_t samples_consumed_ = 0;  ///< by these frames
    bool drawn_ = false;                  ///< one was to be
    gaze::StereoView first_views_{};
};

}  // namespace gazeloop::run
