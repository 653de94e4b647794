#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

namespace gazeloop::gaze {

/// A saccade as a tracker's samples show it.
struct SeenSaccade {
    double amplitude_deg = 0.0;   ///< from where the gaze rested before to where it rests after
    double peak_deg_per_s = 0.0;  ///< the greatest of the speeds, as SaccadeDetector takes them
};

/// Finds saccades while samples pass: by velocity, above a threshold that follows the noise (I-VT,
/// with the threshold of Nystrom and Holmqvist 2010, Behavior Research Methods 42:188: the mean of
/// the resting speeds plus six standard deviations). Mean and deviation are taken from the median,
/// which slow movements hardly change, as those of white noise, whose speeds have a Rayleigh
/// distribution. Causal, in fixed memory, without allocation.
///
/// A speed is the angle between two samples over the time between them: at least 10 ms, and at
/// least two sample intervals. That much is lost of a peak, on purpose: what the rate and the
/// noise do to it can then be reckoned (GazeSmoothing does it with simulated saccades).
///
/// Left out is what lies within 50 ms of a break (blinks end in false saccades), lasts over 300 ms,
/// or is faster than 1200 deg/s, which no eye is.
class SaccadeDetector {
  public:
    /// 10 Hz or more; above 1000 Hz the speed's window shortens.
    explicit SaccadeDetector(double rate_hz);

    /// The same, with the thresholds of this resting speed, which then do not follow the samples.
    SaccadeDetector(double rate_hz, double resting_deg_per_s);

    /// Samples in the order of their times, which must increase; unit vectors. A saccade is told
    /// 50 ms after its end.
    std::optional<SeenSaccade> add(std::int64_t time_ns, const glm::dvec3& direction);

    /// The next sample does not follow on the last one: something is missing between them.
    void break_off();

    /// Median of the speeds at which the gaze rests: drift, and above all the tracker's noise.
    [[nodiscard]] double resting_deg_per_s() const { return resting_deg_per_s_; }
    /// A saccade's peak is above this, deg/s.
    [[nodiscard]] double threshold_deg_per_s() const { return threshold_deg_per_s_; }
    /// How long the window of a speed is, seconds.
    [[nodiscard]] double window_s() const;

  private:
    struct Point {
        std::int64_t time_ns = 0;
        glm::dvec3 direction{0.0, 0.0, -1.0};
    };
    struct Moving {
        std::int64_t begin_ns = 0;
        glm::dvec3 from{0.0, 0.0, -1.0};
        double peak_deg_per_s = 0.0;
    };
    struct Ended {
        std::int64_t end_ns = 0;
        SeenSaccade saccade;
    };

    static constexpr std::size_t kRing = 32;  ///< a power of two, above twice the greatest half
    static constexpr std::size_t kGreatestHalf = 12;

    [[nodiscard]] const Point& back(std::size_t samples) const;
    /// Where the gaze is on average in the half window before the sample that lies so far back.
    [[nodiscard]] glm::dvec3 mean_before(std::size_t samples) const;
    /// The same after it.
    [[nodiscard]] glm::dvec3 mean_after(std::size_t samples) const;
    [[nodiscard]] glm::dvec3 mean_of(std::size_t oldest, std::size_t newest) const;
    void follow(double speed_deg_per_s);
    void set_thresholds();

    double rate_hz_;
    std::size_t half_;    ///< of a speed's window, in samples
    bool fixed_ = false;  ///< thresholds do not follow
    std::array<Point, kRing> ring_{};
    std::uint64_t held_ = 0;  ///< samples since the break
    std::uint64_t place_ = 0;
    std::int64_t unbroken_since_ns_ = 0;
    std::uint64_t rested_ = 0;  ///< speeds that were followed
    double resting_deg_per_s_ = 0.0;
    double threshold_deg_per_s_ = 0.0;
    double edge_deg_per_s_ = 0.0;  ///< a saccade begins and ends here
    std::optional<Moving> moving_;
    std::optional<Ended> ended_;
};

/// The angle between two unit vectors, degrees; exact where it is small.
[[nodiscard]] double angle_between_deg(const glm::dvec3& a, const glm::dvec3& b);

}  // namespace gazeloop::gaze
