#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "runtime/gaze/events/cyclopean_gaze.h"
#include "runtime/gaze/events/gaze_predictor.h"
#include "runtime/gaze/eye.h"
#include "runtime/gaze/filter/fixation_filter.h"
#include "runtime/gaze/filter/one_euro_filter.h"
#include "runtime/gaze/pose.h"

namespace gazeloop::gaze {

enum class GazeFilter : std::uint8_t { None, OneEuro, Fixation };
inline constexpr std::array<std::string_view, 3> kGazeFilterNames{"none", "one-euro", "fixation"};

[[nodiscard]] constexpr std::string_view name(GazeFilter filter) {
    return kGazeFilterNames[static_cast<std::size_t>(filter)];
}

/// What is made of the movement of the gaze. By default nothing.
struct MotionPolicy {
    bool tell_events = false;  ///< also without filter and prediction
    GazeFilter filter = GazeFilter::None;
    OneEuroFilter::Parameters one_euro{};
    FixationFilter::Parameters fixation{};
    bool predict = false;
    std::int64_t longest_prediction_ns = 60'000'000;

    [[nodiscard]] bool is_on() const {
        return tell_events || filter != GazeFilter::None || predict;
    }
};

/// Follows how the gaze moves, in world where the head of the samples is known, else in the head:
/// what the eyes do, each eye's direction filtered, and where both go next. Pure: the same samples
/// give the same bits.
class GazeMotion {
  public:
    explicit GazeMotion(const MotionPolicy& policy);

    /// A sample's directions in the head, unit vectors, none where the eye is not seen; one at
    /// least is. Filters those that are there, in place.
    void add(std::int64_t time_ns, PerEye<std::optional<glm::dvec3>>& in_head,
             const std::optional<Pose>& head);
    /// A sample without gaze.
    void lose(std::int64_t time_ns);
    /// The world turned: the rotation that takes directions of before into the new one.
    void turn_world(const glm::dquat& rotation);

    [[nodiscard]] EyeEvent event() const { return predictor_.detector().event(); }
    [[nodiscard]] SeenMotion seen() const { return predictor_.seen(); }
    /// How much older than the newest sample the filtered direction of an eye is on average.
    [[nodiscard]] std::int64_t filter_delay_ns(Eye eye) const;
    /// In the head of the last sample that had gaze.
    [[nodiscard]] GazePrediction predict(std::int64_t time_ns) const;

  private:
    struct Filters {
        OneEuroFilter one_euro;
        FixationFilter fixation;
    };

    void reset_filter(std::size_t eye);

    MotionPolicy policy_;
    CyclopeanGaze cyclopean_;
    GazePredictor predictor_;
    PerEye<Filters> filters_;
    bool started_ = false;
    std::optional<glm::dquat> head_;  ///< of the last sample with gaze
};

}  // namespace gazeloop::gaze
