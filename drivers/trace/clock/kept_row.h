#pragma once

#include <array>
#include <cstdint>

#include "drivers/trace/clock/trace_row.h"
#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::drivers {

/// What of a row becomes its sample, its clocks apart: as few bytes as that takes, since a long
/// file's rows are written and read again several times.
class KeptRow {
  public:
    KeptRow() = default;
    explicit KeptRow(const TraceRow& row)
        : parallax_rad_(row.parallax_rad.value_or(0.0)),
          head_(row.head.value_or(gaze::Pose{})),
          has_parallax_(row.parallax_rad.has_value()),
          has_head_(row.head.has_value()) {
        for (const gaze::Eye eye : gaze::kEyes) {
            const gaze::EyeRay& ray = row.eyes[gaze::index(eye)];
            eyes_[gaze::index(eye)] = {ray.origin_m, ray.direction, ray.openness, ray.confidence};
            valid_[gaze::index(eye)] = ray.valid;
        }
    }

    [[nodiscard]] bool valid(gaze::Eye eye) const { return valid_[gaze::index(eye)]; }

    /// Whether an eye's ray is the same, where it counts.
    [[nodiscard]] bool same_ray(const KeptRow& other, gaze::Eye eye) const {
        const Ray& a = eyes_[gaze::index(eye)];
        const Ray& b = other.eyes_[gaze::index(eye)];
        return valid(eye) == other.valid(eye) && a.openness == b.openness &&
               a.confidence == b.confidence && a.origin_m == b.origin_m &&
               (!valid(eye) || a.direction == b.direction);
    }

    void write_to(gaze::GazeSample& sample) const {
        for (const gaze::Eye eye : gaze::kEyes) {
            const Ray& ray = eyes_[gaze::index(eye)];
            sample.eyes[gaze::index(eye)] = {.origin_m = ray.origin_m,
                                             .direction = ray.direction,
                                             .openness = ray.openness,
                                             .confidence = ray.confidence,
                                             .valid = valid(eye)};
        }
        if (has_parallax_) {
            sample.parallax_rad = parallax_rad_;
        }
        if (has_head_) {
            sample.head = head_;
        }
    }

  private:
    struct Ray {
        glm::dvec3 origin_m;
        glm::dvec3 direction;
        double openness;
        double confidence;
    };
    gaze::PerEye<Ray> eyes_{};
    double parallax_rad_ = 0.0;
    gaze::Pose head_;
    gaze::PerEye<bool> valid_{};
    bool has_parallax_ = false;
    bool has_head_ = false;
};

}  // namespace gazeloop::drivers
