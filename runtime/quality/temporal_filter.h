#pragma once

#include <array>
#include <cstddef>

#include "runtime/quality/plane.h"
#include "runtime/quality/row_work.h"

namespace gazeloop::quality {

/// Four equal first-order low-passes in a row, each with the corner frequency f_c. Two things are
/// read off them: what stays, H^4, and what changes, (H^2 - H^4) / .677, with
/// H(f) = 1 / (1 + i f / f_c). With f_c = 9.4 Hz these are the temporal responses of stelaCSF's
/// sustained and transient parts, within .08 of their peak of 1 from 0 to 60 Hz, but for the
/// transient one below 3 Hz, where it is up to .17 lower. They need four numbers per pixel and no
/// past frames.
class TemporalResponse {
  public:
    static constexpr std::size_t kStages = 4;

    /// The sustained response is one half at this frequency. Precondition: positive.
    explicit TemporalResponse(double half_response_hz);

    [[nodiscard]] double sustained(double hz) const;
    [[nodiscard]] double transient(double hz) const;

    /// The factors by which a frame that is shown for this long moves the stages: a stage's
    /// distance from the frame becomes the sum over the stages up to it of their distances times
    /// factor[how many stages further]. Exact for a display that holds the frame.
    [[nodiscard]] std::array<float, kStages> held_for(double seconds) const;

    /// What makes the transient response 1 at its peak.
    static constexpr double kTransientGain = 1.0 / 0.677;

  private:
    double corner_hz_;
};

/// One channel of a sequence of pictures, as the eye's temporal responses leave it at the end of
/// each frame. Filtered where it is on the display, whatever the gaze does meanwhile.
class TemporalFilter {
  public:
    explicit TemporalFilter(const TemporalResponse& response) : response_(response) {}

    /// The first frame, and each after forget(), counts as shown for ever before. `seconds`: for
    /// how long this frame is shown. Precondition: all frames have one size.
    void show(const Plane& frame, double seconds, const RowWork& work);
    void forget() { any_ = false; }

    [[nodiscard]] const Plane& sustained() const { return stages_.back(); }
    void transient(const RowWork& work, Plane& plane) const;

  private:
    TemporalResponse response_;
    std::array<Plane, TemporalResponse::kStages> stages_;
    bool any_ = false;
};

}  // namespace gazeloop::quality
