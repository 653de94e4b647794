#include "runtime/foveation/plans/method_plan.h"

namespace gazeloop::foveation {

void ShadedGrid::start(std::uint32_t height) {
    const auto most = [&](std::uint32_t rows) { return (std::size_t{height} + rows - 1) / rows; };
    bands.clear();
    bands.reserve(most(kBandRows));
    tiles.clear();
    tiles.reserve(most(kTileRows));
    counts = {};
}

}  // namespace gazeloop::foveation
