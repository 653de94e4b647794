#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace gazeloop::gaze {

/// Where the gaze was lately, and how fast it moved. Fixed memory, no allocation.
class DirectionHistory {
  public:
    struct Point {
        std::int64_t time_ns = 0;
        glm::dvec3 direction{0.0, 0.0, -1.0};
    };

    /// A power of two: 256 ms at 1000 Hz. Windows that would be longer are cut.
    static constexpr std::size_t kMost = 256;

    /// Times must increase; unit vectors.
    void add(std::int64_t time_ns, const glm::dvec3& direction);
    void clear() { held_ = 0; }
    /// Turns all that is held.
    void turn(const glm::dquat& rotation);

    /// Points that are held, at most kMost.
    [[nodiscard]] std::size_t size() const { return held_; }
    /// The point that lies so many samples before the newest; precondition: less than size().
    [[nodiscard]] const Point& back(std::size_t samples) const {
        return ring_[(place_ - 1 - samples) % kMost];
    }
    /// How many samples back the oldest point is that is no older than `span_ns` before the point
    /// `from` samples back, or that point itself. Precondition: from < size().
    [[nodiscard]] std::size_t oldest_within(std::size_t from, std::int64_t span_ns) const;

    /// From one point to a later one, seconds; both samples back.
    [[nodiscard]] double elapsed_s(std::size_t older, std::size_t newer) const;
    /// The slope of the straight line that fits the newest points best, `oldest` + 1 of them,
    /// deg/s. Precondition: 1 <= oldest < size().
    [[nodiscard]] glm::dvec3 velocity_deg_per_s(std::size_t oldest) const;

  private:
    std::array<Point, kMost> ring_{};
    std::size_t held_ = 0;
    std::size_t place_ = 0;
};

}  // namespace gazeloop::gaze
