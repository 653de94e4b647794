#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "runtime/error.h"

namespace gazeloop::foveation {

/// A kernel through given samples, by monotone piecewise cubics: between rising samples it rises.
/// Fritsch and Carlson 1980, with Brodlie's weighted harmonic means as slopes.
class TableKernel {
  public:
    static constexpr std::size_t kMinSamples = 2;
    static constexpr std::size_t kMaxSamples = 4096;
    /// Least distance of neighbours, in x and in y.
    static constexpr double kMinStep = 1e-9;

    struct Sample {
        double x;
        double y;
    };

    /// What is wrong with samples, and with which.
    struct Flaw {
        std::size_t sample = 0;
        std::string message;  ///< the value and the valid range
    };

    /// Both coordinates must rise by at least kMinStep from sample to sample, from (0, 0) to (1,
    /// 1).
    static std::expected<TableKernel, Flaw> create(std::span<const Sample> samples);

    [[nodiscard]] double operator()(double x) const;
    [[nodiscard]] double inverse(double y) const;
    [[nodiscard]] double derivative(double x) const;
    [[nodiscard]] std::size_t samples() const { return knots_->size(); }
    [[nodiscard]] Sample sample(std::size_t i) const { return {(*knots_)[i].x, (*knots_)[i].y}; }

  private:
    struct Knot {
        double x;
        double y;
        double slope;
    };
    /// A cubic of t in [0, 1] over one interval of x.
    struct Piece {
        double x0;
        double width;
        double y0;
        double c1, c2, c3;

        [[nodiscard]] double value(double t) const { return y0 + t * (c1 + t * (c2 + t * c3)); }
        [[nodiscard]] double slope(double t) const { return c1 + t * (2.0 * c2 + t * 3.0 * c3); }
    };

    explicit TableKernel(std::vector<Knot> knots);
    [[nodiscard]] Piece piece_at(double Knot::* coordinate, double value) const;

    std::shared_ptr<const std::vector<Knot>> knots_;  ///< shared, so that a copy is cheap
};

}  // namespace gazeloop::foveation
