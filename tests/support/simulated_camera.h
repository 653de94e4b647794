#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "sim/random.h"

namespace gazeloop::tests {

/// A lamp that blinds a tracker, a display that answers, and the light of both. Seconds.
struct LampAndDisplay {
    double tracker_s = 0.030;      ///< from the lamp to the frame that may show it
    double found_s = 0.080;        ///< the same for the lamp going off
    double period_s = 1.0 / 90.0;  ///< of the display
    double lit_s = 0.002;          ///< of each period; 0: steady
    double ramp_s = 0.0;           ///< a steady pixel's linear change
};

struct CameraModel {
    double fps = 240.0;
    double exposure = 1.0;   ///< of the time between frames
    double readout_s = 0.0;  ///< from the first row to the last
    double noise = 0.0;      ///< SD of one region's mean, of white
    double flicker = 0.0;    ///< amplitude of mains-driven light on both regions, of white
    double dark = 0.05;      ///< of white
    double bright = 0.6;     ///< where a light is on throughout the exposure
    double lamp_row = 0.5;   ///< of the picture's height
    double patch_row = 0.5;
};

/// When lamp and patch change, and by how much the patch comes later.
struct Truth {
    struct Change {
        double lamp_s = 0.0;
        double patch_s = 0.0;
        bool on = false;
        [[nodiscard]] double delay_s() const { return patch_s - lamp_s; }
    };
    std::vector<Change> changes;
    double seconds = 0.0;

    [[nodiscard]] double mean_ms(bool on) const {
        double sum = 0.0;
        double count = 0.0;
        for (const Change& change : changes) {
            sum += change.on == on ? 1e3 * change.delay_s() : 0.0;
            count += change.on == on ? 1.0 : 0.0;
        }
        return sum / count;
    }
};

/// The lamp is switched at random times. A pulsed display answers with the middle of a pulse, a
/// steady one with the middle of its pixels' change.
inline Truth switch_lamp(const LampAndDisplay& set_up, int flashes, sim::Random& random) {
    Truth truth;
    const double phase_s = random.uniform(0.0, set_up.period_s);
    const auto answer = [&](double lamp_s, double after_s) {
        const double frame = std::ceil((lamp_s + after_s - phase_s) / set_up.period_s);
        return phase_s + frame * set_up.period_s + 0.5 * set_up.ramp_s;
    };
    double now_s = 0.3;
    for (int i = 0; i < flashes; ++i) {
        now_s += random.uniform(0.25, 0.35);
        truth.changes.push_back({now_s, answer(now_s, set_up.tracker_s), true});
        now_s += random.uniform(0.25, 0.35);
        truth.changes.push_back({now_s, answer(now_s, set_up.found_s), false});
    }
    truth.seconds = now_s + 0.4;
    return truth;
}

/// What a camera makes of it: the mean brightness of either region in each frame, linear light.
class SimulatedCamera {
  public:
    SimulatedCamera(const CameraModel& model, const LampAndDisplay& set_up, const Truth& truth,
                    std::uint64_t seed)
        : model_(model),
          set_up_(set_up),
          truth_(&truth),
          random_(seed, sim::Stream::Noise),
          start_s_(random_.uniform(0.0, 1.0 / model.fps)) {}

    [[nodiscard]] std::size_t frames() const {
        return static_cast<std::size_t>(truth_->seconds * model_.fps);
    }
    /// In the order of the frames.
    struct Pair {
        double lamp = 0.0;
        double patch = 0.0;
    };
    Pair next() {
        const double at_s = start_s_ + static_cast<double>(frame_++) / model_.fps;
        return {seen(at_s + model_.lamp_row * model_.readout_s,
                     [this](double a, double b) { return lamp_light(a, b); }),
                seen(at_s + model_.patch_row * model_.readout_s,
                     [this](double a, double b) { return patch_light(a, b); })};
    }

  private:
    template <typename Light>
    double seen(double begin_s, const Light& light) {
        const double exposure_s = model_.exposure / model_.fps;
        const double share = light(begin_s, begin_s + exposure_s) / exposure_s;
        const double mains = std::sin(2.0 * std::numbers::pi * 100.0 * (begin_s + exposure_s / 2));
        const double noise = model_.noise > 0.0 ? model_.noise * random_.normal() : 0.0;
        return std::clamp(
            model_.dark + (model_.bright - model_.dark) * share + model_.flicker * mains + noise,
            0.0, 1.0);
    }

    [[nodiscard]] double lamp_light(double a, double b) const {
        double light = 0.0;
        for (std::size_t i = 0; i + 1 < truth_->changes.size(); i += 2) {
            light += overlap(a, b, truth_->changes[i].lamp_s, truth_->changes[i + 1].lamp_s);
        }
        return light;
    }

    [[nodiscard]] double patch_light(double a, double b) const {
        double light = 0.0;
        for (std::size_t i = 0; i + 1 < truth_->changes.size(); i += 2) {
            const double on_s = truth_->changes[i].patch_s;
            const double off_s = truth_->changes[i + 1].patch_s;
            if (set_up_.lit_s > 0.0) {
                light += pulses(a, b, on_s, off_s);
            } else {
                light +=
                    ramped(b - on_s) - ramped(a - on_s) - ramped(b - off_s) + ramped(a - off_s);
            }
        }
        return light;
    }

    /// A pulse as bright as a full exposure of steady light would be.
    [[nodiscard]] double pulses(double a, double b, double on_s, double off_s) const {
        const double strength = std::min(set_up_.period_s, 1.0 / model_.fps) / set_up_.lit_s;
        double light = 0.0;
        const double first = std::max(0.0, std::floor((a - on_s) / set_up_.period_s) - 1.0);
        const double pulses = std::round((off_s - on_s) / set_up_.period_s);
        for (double k = first; k < pulses && on_s + (k - 1.0) * set_up_.period_s < b; k += 1.0) {
            const double middle = on_s + k * set_up_.period_s;
            light +=
                strength * overlap(a, b, middle - set_up_.lit_s / 2, middle + set_up_.lit_s / 2);
        }
        return light;
    }

    /// The integral of a step at 0 whose linear ramp has its middle there.
    [[nodiscard]] double ramped(double t) const {
        const double half = set_up_.ramp_s / 2;
        if (t <= -half) {
            return 0.0;
        }
        if (t >= half) {
            return t;
        }
        return (t + half) * (t + half) / (4.0 * half);
    }

    static double overlap(double a, double b, double c, double d) {
        return std::max(0.0, std::min(b, d) - std::max(a, c));
    }

    CameraModel model_;
    LampAndDisplay set_up_;
    const Truth* truth_;
    sim::Random random_;
    double start_s_;
    std::size_t frame_ = 0;
};

}  // namespace gazeloop::tests
