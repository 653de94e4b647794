#include "runtime/methods/rings_settings.h"

#include "runtime/foveation/eye/guenter_acuity.h"
#include "runtime/methods/only_under.h"

namespace gazeloop::methods {

using foveation::RingParameters;

std::vector<settings::SettingRow> rows_of(RingsSettings& rings) {
    using settings::Concerns;
    using settings::Number;
    const settings::OnlyWhile only = only_under({"rings"});
    return {
        {"rings.inner_deg",
         "one sample per pixel up to this eccentricity; both 0: as acuity.mar asks",
         Number{&rings.inner_deg, 0.0, 180.0}, Concerns::Picture, only},
        {"rings.outer_deg", "one sample per 2x2 pixels from there to this one, per 4x4 beyond",
         Number{&rings.outer_deg, 0.0, 180.0}, Concerns::Picture, only},
        {"rings.tile_px", "side of a tile, all of which has one rate",
         settings::Whole{&rings.tile_px, RingParameters::kMinTilePx, RingParameters::kMaxTilePx},
         Concerns::Picture, only},
    };
}

Expected<RingParameters> parameters(const RingsSettings& rings, const gaze::EyeView& view,
                                    const foveation::MarLine& line) {
    const auto tile_px = static_cast<std::uint32_t>(rings.tile_px);
    if (rings.inner_deg != 0.0 || rings.outer_deg != 0.0) {
        return RingParameters{rings.inner_deg, rings.outer_deg, tile_px};
    }
    const auto model = foveation::GuenterAcuity::create(line);
    if (!model) {
        return std::unexpected(model.error());
    }
    return foveation::sufficient_rings(view, **model, 0.0, tile_px);
}

}  // namespace gazeloop::methods
