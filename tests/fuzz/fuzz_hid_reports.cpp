// Any bytes as reports of a tracker with one of three layouts: rays that are unit vectors or
// invalid.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <vector>

#include "drivers/hid/eye_tracker_reports.h"
#include "drivers/hid/screen_gaze.h"
#include "tests/unit/drivers/hid/descriptor_items.h"

namespace {

using namespace gazeloop;
using namespace gazeloop::drivers::hid;

void require(bool held) {
    if (!held) {
        std::abort();
    }
}

EyeTrackerLayout layout_of(const std::vector<std::uint8_t>& descriptor) {
    return value_or_throw(find_eye_tracker(value_or_throw(parse_report_descriptor(descriptor))));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::array layouts{layout_of(first_layout()), layout_of(second_layout()),
                                    layout_of(second_layout(false))};
    if (size == 0) {
        return 0;
    }
    const EyeTrackerLayout& layout = layouts[data[0] % layouts.size()];
    const std::span<const std::uint8_t> bytes(data + 1, size - 1);
    const InputReport input = decode_input(layout, bytes);
    if (const auto* const report = std::get_if<TrackingReport>(&input)) {
        for (const ScreenGeometry& geometry :
             {ScreenGeometry{}, ScreenGeometry{0.5, 0.3, 0.6, 0.063}}) {
            for (const gaze::EyeRay& ray : eye_rays(*report, geometry)) {
                require(!ray.valid || std::abs(glm::length(ray.direction) - 1.0) < 1e-9);
                require(std::isfinite(ray.origin_m.x) && std::isfinite(ray.origin_m.y) &&
                        std::isfinite(ray.origin_m.z));
            }
        }
    }
    if (!bytes.empty()) {
        const FeatureReport feature{bytes[0], {bytes.begin(), bytes.end()}};
        const TrackerFeatures features = decode_features(layout, std::span(&feature, 1));
        for (const auto& length : {features.minimum_distance_m, features.maximum_width_m,
                                   features.screen_width_m, features.screen_height_m}) {
            require(!length || (*length >= 0.01 && *length <= 10.0));
        }
    }
    return 0;
}
