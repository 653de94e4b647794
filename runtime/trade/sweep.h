#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "runtime/settings/settings.h"
#include "runtime/trade/sweep_question.h"
#include "runtime/trade/sweep_record.h"
#include "runtime/trade/swept_values.h"
#include "runtime/vulkan/context.h"

namespace gazeloop::trade {

/// A frame of a point, as it was compared.
struct ComparedFrame {
    std::size_t of_case = 0;
    std::size_t point = 0;
    std::size_t frame = 0;
    std::uint64_t cells = 0;  ///< shaded, both eyes
    const quality::FrameQuality& quality;
};

/// Told of what was measured before anything else is measured.
struct SweepHooks {
    std::function<void(const std::string& said)> progress;
    std::function<bool()> interrupted;
    /// Errors end the sweep: what cannot be kept is not worth measuring.
    std::function<Expected<void>(const JudgedPoint&)> judged;
    std::function<Expected<void>(const TimedTurn&)> timed;
    /// What the processor has taken so far, J; none: it cannot be told now. Empty: never.
    std::function<std::optional<double>()> joules{};
    /// Of each frame that is compared; may be empty.
    std::function<void(const ComparedFrame&)> compared{};
};

/// Measures what `record` lacks of this shard and adds it. Case by case: quality first, each point
/// with a history of its own and new, against full resolution without filters; then the timed
/// rounds, frame by frame, all points in turns. Every point has rendered all of the case's frames
/// once before its first timed one, also where a sweep goes on. `values` are those whose rows
/// `settings` hold; they are as before in the end. A point that fails says so in its record.
/// Errors: as scene and device (SetupError is thrown); Usage where the reference's frames take more
/// than kMostReferenceBytes; BadInput where a scene's first frame is not what the record says it
/// was; Interrupted.
Expected<void> sweep(const vulkan::Context& context, const SweepQuestion& question,
                     const SweptValues& values, settings::Settings& settings,
                     const SweepHooks& hooks, SweepRecord& record);

inline constexpr std::uint64_t kMostReferenceBytes = std::uint64_t{4} << 30U;

}  // namespace gazeloop::trade
