#include "runtime/numerics/envelope_groups.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace gazeloop::numerics {
namespace {

/// Useful parameters first, then how close the row comes to its target.
std::pair<bool, double> closeness(const EnvelopeRow& row) {
    return {row.useless.empty(), std::max(row.cpu.largest_px() / row.target_px,
                                          row.device.largest_px() / row.device_target_px)};
}

EnvelopeGroup group_of(const std::vector<const EnvelopeRow*>& rows) {
    const EnvelopeRow& closest = **std::ranges::max_element(
        rows, {}, [](const EnvelopeRow* row) { return closeness(*row); });
    EnvelopeGroup group{.map = closest.map,
                        .image = closest.image,
                        .on_screen = closest.on_screen,
                        .rows = rows.size(),
                        .cpu_px = closest.cpu.largest_px(),
                        .device_px = closest.device.largest_px(),
                        .bound_px = std::max(closest.forward_bound_px, closest.inverse_bound_px),
                        .conditioning_px = closest.conditioning_px,
                        .target_px = closest.target_px};
    for (const EnvelopeRow* const row : rows) {
        group.seam_px = std::max({group.seam_px, row->cpu.seam_px, row->device.seam_px});
        group.fall_px = std::max({group.fall_px, row->cpu.fall_px, row->device.fall_px});
        group.texels = std::max(group.texels, row->forward_texels);
        group.not_finite += row->cpu.not_finite + row->device.not_finite;
        group.beyond_bound += row->beyond_bound;
        if (!row->useless.empty()) {
            ++group.useless;
            group.why_useless = row->useless;
            group.useless_where = fmt::format("sigma {}, fovea {}", row->sigma, row->fovea);
        }
        group.met = group.met && row->met();
    }
    return group;
}

}  // namespace

std::vector<EnvelopeGroup> grouped(const Envelope& envelope) {
    std::vector<std::vector<const EnvelopeRow*>> gathered;
    for (const EnvelopeRow& row : envelope.rows) {
        const auto found = std::ranges::find_if(gathered, [&](const auto& rows) {
            const EnvelopeRow& other = *rows.front();
            return other.map == row.map && other.image.width_px == row.image.width_px &&
                   other.image.height_px == row.image.height_px && other.on_screen == row.on_screen;
        });
        if (found == gathered.end()) {
            gathered.push_back({&row});
        } else {
            found->push_back(&row);
        }
    }
    std::vector<EnvelopeGroup> groups;
    groups.reserve(gathered.size());
    for (const auto& rows : gathered) {
        groups.push_back(group_of(rows));
    }
    return groups;
}

}  // namespace gazeloop::numerics
