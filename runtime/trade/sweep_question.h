#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "runtime/error.h"
#include "runtime/gaze/eye.h"
#include "runtime/gaze/view.h"
#include "runtime/quality/comparison.h"
#include "runtime/settings/settings.h"
#include "runtime/trade/sweep_record.h"

namespace gazeloop::trade {

/// A scene, and where each eye looks in it.
struct CaseQuestion {
    std::string scene;
    std::string gaze;  ///< as it was asked for
    /// Each eye's direction in its view frame, by frame; as many as all other cases have, not none.
    std::vector<gaze::PerEye<glm::dvec3>> directions{};
    /// The head's pose in world, by frame; empty: it stays where the views' poses are given.
    std::vector<gaze::Pose> heads{};
};

/// What every point of a sweep renders: the same frames, both eyes, into pictures that no display
/// shows; one eye's are compared.
struct SweepQuestion {
    gaze::StereoView views;
    std::string display;  ///< its name
    std::vector<CaseQuestion> cases{};
    std::uint32_t samples = 1;             ///< per texel or pixel
    std::uint32_t reference_samples = 16;  ///< of full resolution, which is the reference
    double frame_seconds = 1.0 / 90.0;
    /// The first frame that counts for quality and samples; those before are rendered and seen all
    /// the same, and timed.
    std::size_t first_judged = 0;
    unsigned rounds = 3;  ///< of which times are the medians
    /// Its view is that of its eye. More than one frame: a sequence.
    quality::ComparisonQuestion comparison{};
    Shard shard{};
    bool with_pictures = false;  ///< keeps each point's last frame, small, and where it differs
};

/// A record that nothing is measured of yet: full resolution, then the points (`full` where a
/// setting makes it another).
/// Errors: a line that check_mar_line refuses, a gaze that no view has.
Expected<SweepRecord> begin_record(const SweepQuestion& question,
                                   const std::vector<SweepPoint>& points,
                                   const settings::Settings& settings, std::string device);

}  // namespace gazeloop::trade
