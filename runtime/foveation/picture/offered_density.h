#pragma once

#include <glm/mat2x2.hpp>
#include <string>

#include "runtime/foveation/picture/gaze_field.h"

namespace gazeloop::foveation {

/// The grid of samples around a point, taken as regular there. Each member is the gradient of one
/// sample coordinate: samples per unit along each of two axes. In pixels the axes are the picture's
/// x and y; in degrees they point outward from the gaze and around it.
struct SampleGrid {
    glm::dvec2 first{0.0};   ///< gradient of the first sample coordinate
    glm::dvec2 second{0.0};  ///< gradient of the second

    /// A square grid of this many samples per unit.
    static SampleGrid square(double per_unit) { return {{per_unit, 0.0}, {0.0, per_unit}}; }

    /// Samples per unit in the direction that the grid serves worst. This is the length of the
    /// shortest vector of the reciprocal lattice, which the gradients span. Gratings of up to half
    /// as many cycles per unit pass without aliasing in every direction (Petersen and Middleton
    /// 1962).
    [[nodiscard]] double worst_density() const;

    /// Converts a grid given in pixels to the same grid in degrees at this point.
    [[nodiscard]] SampleGrid in_degrees(const FieldPoint& at) const;
};

/// The samples that a method offers around each point of the visual field, in one picture at one
/// gaze. Every method that is to be judged by an acuity model implements this.
class OfferedDensity {
  public:
    OfferedDensity() = default;
    OfferedDensity(const OfferedDensity&) = delete;
    OfferedDensity& operator=(const OfferedDensity&) = delete;
    virtual ~OfferedDensity() = default;

    /// The grid in degrees: first axis outward from the gaze, second around it. A method that works
    /// in pixels returns SampleGrid::in_degrees(at).
    [[nodiscard]] virtual SampleGrid at(const FieldPoint& at) const = 0;
};

/// Every pixel is a sample: what the display itself can show.
class FullDensity final : public OfferedDensity {
  public:
    [[nodiscard]] SampleGrid at(const FieldPoint& at) const override {
        return SampleGrid::square(1.0).in_degrees(at);
    }
};

}  // namespace gazeloop::foveation
