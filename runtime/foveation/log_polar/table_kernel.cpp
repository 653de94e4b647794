#include "runtime/foveation/log_polar/table_kernel.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "runtime/foveation/log_polar/monotone_root.h"

namespace gazeloop::foveation {
namespace {

/// The slope at an end from three samples, kept such that the first piece stays monotone.
double end_slope(double width0, double width1, double secant0, double secant1) {
    const double slope = ((2.0 * width0 + width1) * secant0 - width0 * secant1) / (width0 + width1);
    return std::clamp(slope, 0.0, 3.0 * secant0);
}

}  // namespace

std::expected<TableKernel, TableKernel::Flaw> TableKernel::create(std::span<const Sample> samples) {
    const auto refuse = [](std::size_t sample, std::string message) {
        return std::unexpected(Flaw{sample, std::move(message)});
    };
    const std::size_t n = samples.size();
    if (n < kMinSamples || n > kMaxSamples) {
        return refuse(n == 0 ? 0 : n - 1,
                      fmt::format("a kernel's table of {} samples: it must have {} to {}", n,
                                  kMinSamples, kMaxSamples));
    }
    for (std::size_t i = 0; i < n; ++i) {
        const Sample& at = samples[i];
        if (!(at.x >= 0.0 && at.x <= 1.0 && at.y >= 0.0 && at.y <= 1.0)) {
            return refuse(i, fmt::format("({}, {}): both must lie in [0, 1]", at.x, at.y));
        }
        if (i > 0 &&
            !(at.x - samples[i - 1].x >= kMinStep && at.y - samples[i - 1].y >= kMinStep)) {
            return refuse(i, fmt::format("({}, {}) follows ({}, {}): both must rise, each by {} "
                                         "at least",
                                         at.x, at.y, samples[i - 1].x, samples[i - 1].y, kMinStep));
        }
    }
    if (samples.front().x != 0.0 || samples.front().y != 0.0) {
        return refuse(0, fmt::format("({}, {}): the first sample must be (0, 0)", samples[0].x,
                                     samples[0].y));
    }
    if (samples.back().x != 1.0 || samples.back().y != 1.0) {
        return refuse(n - 1, fmt::format("({}, {}): the last sample must be (1, 1)",
                                         samples.back().x, samples.back().y));
    }

    std::vector<double> width;
    std::vector<double> secant;
    for (std::size_t i = 0; i + 1 < n; ++i) {
        width.push_back(samples[i + 1].x - samples[i].x);
        secant.push_back((samples[i + 1].y - samples[i].y) / width.back());
    }
    std::vector<Knot> knots;
    for (std::size_t i = 0; i < n; ++i) {
        double slope = secant[0];  // of two samples: a line
        if (n > 2 && i == 0) {
            slope = end_slope(width[0], width[1], secant[0], secant[1]);
        } else if (n > 2 && i == n - 1) {
            slope = end_slope(width[n - 2], width[n - 3], secant[n - 2], secant[n - 3]);
        } else if (n > 2) {
            const double before = 2.0 * width[i] + width[i - 1];
            const double after = width[i] + 2.0 * width[i - 1];
            slope = (before + after) / (before / secant[i - 1] + after / secant[i]);
        }
        knots.push_back({samples[i].x, samples[i].y, slope});
    }
    return TableKernel(std::move(knots));
}

TableKernel::TableKernel(std::vector<Knot> knots)
    : knots_(std::make_shared<const std::vector<Knot>>(std::move(knots))) {}

TableKernel::Piece TableKernel::piece_at(double Knot::* coordinate, double value) const {
    const auto above = std::ranges::upper_bound(*knots_, value, {}, coordinate);
    const auto last = static_cast<std::ptrdiff_t>(knots_->size()) - 2;
    const auto i =
        static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - knots_->begin() - 1, 0, last));
    const Knot& a = (*knots_)[i];
    const Knot& b = (*knots_)[i + 1];
    const double width = b.x - a.x;
    const double rise = b.y - a.y;
    const double s0 = a.slope * width;
    const double s1 = b.slope * width;
    return {a.x, width, a.y, s0, 3.0 * rise - 2.0 * s0 - s1, s0 + s1 - 2.0 * rise};
}

double TableKernel::operator()(double x) const {
    if (x >= 1.0) {
        return 1.0;  // the last cubic may round below it
    }
    const Piece piece = piece_at(&Knot::x, x);
    const double t = std::clamp((x - piece.x0) / piece.width, 0.0, 1.0);
    return std::clamp(piece.value(t), 0.0, 1.0);
}

double TableKernel::derivative(double x) const {
    const Piece piece = piece_at(&Knot::x, x);
    const double t = std::clamp((x - piece.x0) / piece.width, 0.0, 1.0);
    return std::max(piece.slope(t), 0.0) / piece.width;
}

double TableKernel::inverse(double y) const {
    if (y <= 0.0 || y >= 1.0) {
        return y <= 0.0 ? 0.0 : 1.0;
    }
    const Piece piece = piece_at(&Knot::y, y);
    const double t = monotone_root([&](double at) { return piece.value(at); },
                                   [&](double at) { return piece.slope(at); }, 0.0, 1.0, y);
    return std::clamp(piece.x0 + t * piece.width, 0.0, 1.0);
}

}  // namespace gazeloop::foveation
