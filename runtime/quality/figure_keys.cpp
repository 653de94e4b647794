#include "runtime/quality/figure_keys.h"

#include <algorithm>

#include "runtime/quality/quality_totals.h"
#include "runtime/settings/nearest_name.h"

namespace gazeloop::quality {

std::vector<std::string> figure_keys(const MetricChoice& metrics) {
    FrameQuality any;
    const auto asked = [&](Metric metric) { return metrics[static_cast<std::size_t>(metric)]; };
    if (asked(Metric::Contrast)) {
        any.contrast.emplace();
    }
    if (asked(Metric::Flip)) {
        any.flip.emplace();
    }
    if (asked(Metric::Ssim)) {
        any.ssim.emplace();
    }
    if (asked(Metric::Psnr)) {
        any.psnr_db.emplace();
    }
    std::vector<std::string> keys;
    for (const auto& [key, value] : figures_of(any)) {
        keys.push_back(key);
    }
    return keys;
}

Expected<void> check_figure(const std::string& key, const MetricChoice& metrics) {
    const std::vector<std::string> keys = figure_keys(metrics);
    if (std::ranges::find(keys, key) == keys.end()) {
        return std::unexpected(
            Error{ErrorKind::Usage, "--limit: " + settings::unknown_name("figure", key, keys)});
    }
    return {};
}

}  // namespace gazeloop::quality
