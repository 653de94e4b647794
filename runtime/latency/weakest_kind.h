#pragma once

#include <array>
#include <cstdint>

#include "runtime/time/stamp.h"

namespace gazeloop::latency {

/// The least certain kind among the known ones, of frames counted by how they know a quantity;
/// unknown where no frame knows it.
constexpr time::StampKind weakest_kind(
    const std::array<std::uint64_t, time::kStampKindCount>& frames_by_kind) {
    // The enumerators stand in the order of certainty (see weaker()).
    for (std::size_t kind = time::kStampKindCount - 1; kind > 0; --kind) {
        if (frames_by_kind[kind] > 0) {
            return static_cast<time::StampKind>(kind);
        }
    }
    return time::StampKind::Unknown;
}

}  // namespace gazeloop::latency
