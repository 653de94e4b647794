#include "runtime/methods/acuity_settings.h"

#include "runtime/foveation/eye/stela_csf.h"
#include "runtime/foveation/log_polar/log_polar_map.h"
#include "runtime/methods/only_under.h"

namespace gazeloop::methods {

std::vector<settings::SettingRow> rows_of(AcuitySettings& acuity) {
    using foveation::StelaConditions;
    using settings::Concerns;
    using settings::Number;
    using settings::Whole;
    const settings::OnlyWhile only = only_under({"acuity"});
    return {
        {"acuity.border_px", "width of the blend between disc and LP-buffer, px at the gaze",
         Number{&acuity.border_px, 0.0, 64.0}, Concerns::Picture, only},
        {"acuity.disc", "shade pixels directly where the display, not the eye, is the limit",
         &acuity.disc, Concerns::Picture, only},
        {"acuity.lp_height", "rows of the LP-buffer; 0: as many as the eye needs",
         Whole{&acuity.lp_height, 0, foveation::LpSize::kMaxSide}, Concerns::Picture, only},
        {"acuity.lp_width", "columns of the LP-buffer; 0: as many as the eye needs",
         Whole{&acuity.lp_width, 0, foveation::LpSize::kMaxSide}, Concerns::Picture, only},
        {"acuity.luminance_cd_m2", "luminance of the picture for stelaCSF, cd/m2",
         Number{&acuity.luminance_cd_m2, StelaConditions::kMinLuminance,
                StelaConditions::kMaxLuminance},
         Concerns::Output},
        // Layers and rings take their eccentricities from the line too.
        {"acuity.mar",
         "slope m of the minimum angle of resolution at e deg, m e + 1/48 deg per cycle",
         Number{&acuity.mar, foveation::MarLine::kMinSlope, foveation::MarLine::kMaxSlope},
         Concerns::Picture, only_under({"acuity", "layers", "rings"})},
        {"acuity.nasal",
         "stelaCSF: sharper towards the nose; else as on the temporal side everywhere",
         &acuity.nasal, Concerns::Output},
        {"acuity.pixels_per_degree",
         "display density that the map is made for; 0: the greatest in view",
         Number{&acuity.pixels_per_degree, 0.0, foveation::AcuityParameters::kMaxPixelsPerDegree},
         Concerns::Picture, only},
    };
}

foveation::AcuityParameters parameters(const AcuitySettings& acuity) {
    return {.mar = {.slope = acuity.mar},
            .pixels_per_degree = acuity.pixels_per_degree,
            .lp_width = static_cast<std::uint32_t>(acuity.lp_width),
            .lp_height = static_cast<std::uint32_t>(acuity.lp_height),
            .disc = acuity.disc,
            .border_px = acuity.border_px};
}

}  // namespace gazeloop::methods
