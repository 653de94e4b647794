// The views of a picture by their regions, as foveation/plans/kfr3d_plan.h lists them: region r has
// the views [region_views[r], region_views[r + 1]).
const int kMostRegions = 4;
const uint kViewsBegin = 8u;  // words

layout(std430, set = 2, binding = 10) readonly buffer RegionViews { uint region_views[]; };

SceneView view_at(uint i) {
    uint at = kViewsBegin + 4u * i;
    return SceneView(vec2(uintBitsToFloat(region_views[at]), uintBitsToFloat(region_views[at + 1u])),
                     uintBitsToFloat(region_views[at + 2u]), uintBitsToFloat(region_views[at + 3u]));
}

bool has_views(int region) { return region_views[region] < region_views[region + 1]; }
