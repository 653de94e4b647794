#include "runtime/foveation/plans/nearest_samples.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <nanoflann.hpp>

namespace gazeloop::foveation {
namespace {

/// The samples as nanoflann wants to see them.
struct Cloud {
    const std::vector<FieldPixel>& samples;

    [[nodiscard]] std::size_t kdtree_get_point_count() const { return samples.size(); }
    [[nodiscard]] double kdtree_get_pt(std::size_t index, std::size_t axis) const {
        return axis == 0 ? samples[index].x : samples[index].y;
    }
    template <typename Box>
    bool kdtree_get_bbox(Box& /*box*/) const {
        return false;  // let it find the box itself
    }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<
    nanoflann::L2_Simple_Adaptor<double, Cloud, double, std::uint32_t>, Cloud, 2, std::uint32_t>;

}  // namespace

Expected<NearestSamples> find_nearest_samples(const SparsePattern& pattern,
                                              std::uint32_t neighbours) {
    const std::size_t most =
        std::min<std::size_t>(NearestSamples::kMaxNeighbours, pattern.samples.size());
    if (neighbours < 1 || neighbours > most) {
        return std::unexpected(
            Error{ErrorKind::Usage, fmt::format("sparse.k = {}: must lie in [1, {}] for a pattern "
                                                "of {} samples",
                                                neighbours, most, pattern.samples.size())});
    }
    const Cloud cloud{pattern.samples};
    const Tree tree(2, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(16));
    NearestSamples nearest{.field = pattern.field(), .neighbours = neighbours, .map = {}};
    nearest.map.resize(std::size_t{nearest.field.width_px} * nearest.field.height_px * neighbours);
    std::array<double, NearestSamples::kMaxNeighbours> distances2{};
    std::uint32_t* entry = nearest.map.data();
    for (std::uint32_t y = 0; y < nearest.field.height_px; ++y) {
        for (std::uint32_t x = 0; x < nearest.field.width_px; ++x) {
            const std::array<double, 2> pixel{static_cast<double>(x), static_cast<double>(y)};
            tree.knnSearch(pixel.data(), neighbours, entry, distances2.data());
            entry += neighbours;
        }
    }
    return nearest;
}

}  // namespace gazeloop::foveation
