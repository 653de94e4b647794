#include "runtime/render/run_lists.h"

#include <fmt/core.h>

namespace gazeloop::render {
namespace {

/// Names of both, in the order in which they come. Throws SetupError (Usage).
frame::NameList together(const frame::NameList& first, const frame::NameList& second,
                         std::size_t most, std::string_view whose, std::string_view what) {
    std::string text = first.text();
    for (const std::string& name : second.names()) {
        if (!first.find(name)) {
            text += (text.empty() ? "" : " ") + name;
        }
    }
    auto all = frame::NameList::parse(text, most);
    if (!all) {
        throw SetupError(ErrorKind::Usage,
                         fmt::format("{} have more {} together than a session can keep ({}): {}",
                                     whose, what, most, text));
    }
    return std::move(*all);
}

}  // namespace

void RunLists::add(const FrameRenderer& renderer) {
    passes_ = together(passes_, renderer.passes(), frame::kMostPasses, whose_, "passes");
    grids_ = together(grids_, renderer.grids(), frame::kMostGrids, whose_, "grids");
}

frame::SampleCounts RunLists::in_run(const FrameRenderer& renderer,
                                     const frame::SampleCounts& counts) const {
    frame::SampleCounts placed = counts;
    placed.grids.fill({});
    placed.grid_count = static_cast<std::uint32_t>(grids_.size());
    for (std::size_t grid = 0; grid < counts.grid_count; ++grid) {
        placed.grids[*grids_.find(renderer.grids()[grid])] = counts.grids[grid];
    }
    return placed;
}

frame::FrameGpuRecord RunLists::in_run(const FrameRenderer& renderer,
                                       const frame::FrameGpuRecord& record) const {
    frame::FrameGpuRecord placed = record;
    placed.passes = {};
    placed.pass_starts = {};
    for (std::size_t pass = 0; pass < renderer.passes().size(); ++pass) {
        const std::size_t place = *passes_.find(renderer.passes()[pass]);
        placed.passes.set(place, record.passes[pass]);
        placed.pass_starts.set(place, record.pass_starts[pass]);
    }
    return placed;
}

}  // namespace gazeloop::render
