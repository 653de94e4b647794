#include "runtime/methods/sparse_settings.h"

#include "runtime/foveation/plans/nearest_samples.h"
#include "runtime/methods/only_under.h"

namespace gazeloop::methods {
namespace {

constexpr const char* kBlueNoise = "blue_noise";

}  // namespace

using foveation::SparseParameters;

std::vector<settings::SettingRow> rows_of(SparseSettings& sparse) {
    using settings::Concerns;
    using settings::Number;
    const settings::OnlyWhile only = only_under({"sparse"});
    return {
        {"sparse.accumulate", "mix what the last frames' samples showed into each frame",
         &sparse.accumulate, Concerns::Picture, only},
        {"sparse.depth_guided", "neighbours count less that are not as far away as the nearest one",
         &sparse.depth_guided, Concerns::Picture, only},
        {"sparse.disc_share", "share of the samples that the full disc takes",
         Number{&sparse.disc_share, 0.0, 0.9}, Concerns::Picture, only},
        {"sparse.k", "nearest samples that a pixel is filled from, by inverse distance",
         settings::Whole{&sparse.k, 1, foveation::NearestSamples::kMaxNeighbours},
         Concerns::Picture, only},
        {"sparse.narrow_share", "share of the draws from the narrow Gaussian",
         Number{&sparse.narrow_share, 0.0, 1.0}, Concerns::Picture, only},
        {"sparse.narrow_spread", "SD of the narrow Gaussian, relative to the picture's diagonal",
         Number{&sparse.narrow_spread, SparseParameters::kMinSpread, SparseParameters::kMaxSpread},
         Concerns::Picture, only},
        {"sparse.placement", "how samples are placed",
         settings::Choice{.value = &sparse.placement, .names = {"gaussian", kBlueNoise}},
         Concerns::Picture, only},
        {"sparse.share", "samples per pixel of the picture, gaze at the centre",
         Number{&sparse.share, SparseParameters::kMinShare, SparseParameters::kMaxShare},
         Concerns::Picture, only},
        {"sparse.turn", "turn and mirror the pattern about the gaze, another way in each frame",
         &sparse.turn, Concerns::Picture, only},
        {"sparse.wide_spread", "SD of the wide Gaussian, relative to the picture's diagonal",
         Number{&sparse.wide_spread, SparseParameters::kMinSpread, SparseParameters::kMaxSpread},
         Concerns::Picture, only},
    };
}

SparseParameters parameters(const SparseSettings& sparse) {
    return {.share = sparse.share,
            .disc_share = sparse.disc_share,
            .narrow_share = sparse.narrow_share,
            .narrow_spread = sparse.narrow_spread,
            .wide_spread = sparse.wide_spread,
            .placement = sparse.placement == kBlueNoise ? foveation::SparsePlacement::BlueNoise
                                                        : foveation::SparsePlacement::Gaussian};
}

}  // namespace gazeloop::methods
