#pragma once

#include <memory>

#include "runtime/foveation/plans/sparse_plan.h"
#include "runtime/render/passes/method_passes.h"

namespace gazeloop::render {

struct SparseConfig {
    foveation::SparseOptions plan;
    /// Samples count less the more their distance differs from the nearest one's.
    bool depth_guided = false;
    /// Frames are accumulated: pixels keep what samples of the last frames showed of them.
    bool accumulate = false;
};

/// Sparse sampling: samples, accumulate (if asked for) and resolve. Its prepare() throws SetupError
/// (Usage) as make_sparse_pattern and find_nearest_samples report, and where the table of
/// neighbours is larger than the device lets a shader read.
[[nodiscard]] std::unique_ptr<MethodPasses> make_sparse_passes(const PassSetup& setup,
                                                               const SparseConfig& config);

}  // namespace gazeloop::render
