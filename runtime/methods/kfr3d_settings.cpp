#include "runtime/methods/kfr3d_settings.h"

#include "runtime/foveation/plans/kfr3d_plan.h"
#include "runtime/methods/only_under.h"

namespace gazeloop::methods {

std::vector<settings::SettingRow> rows_of(Kfr3dSettings& kfr3d) {
    using foveation::Kfr3dParameters;
    using settings::Concerns;
    using settings::Number;
    using settings::Whole;
    const settings::OnlyWhile only = only_under({"kfr3d"});
    return {
        {"kfr3d.growth", "sigma of a region of views over that of the one inside it",
         Number{&kfr3d.growth, 1.0, Kfr3dParameters::kMostGrowth}, Concerns::Picture, only},
        {"kfr3d.inner", "radius of the foveal region of views, as a share of the lens's reach",
         Number{&kfr3d.inner, 0.0, 1.0}, Concerns::Picture, only},
        {"kfr3d.regions", "regions of views by distance from the gaze, each with its own sigma",
         Whole{&kfr3d.regions, 1, Kfr3dParameters::kMostRegions}, Concerns::Picture, only},
    };
}

}  // namespace gazeloop::methods
