#include "runtime/methods/interleaved_settings.h"

#include <fmt/core.h>

#include "runtime/foveation/plans/cell_turns.h"
#include "runtime/methods/only_under.h"
#include "runtime/render/passes/interleaved_passes.h"

namespace gazeloop::methods {

std::vector<settings::SettingRow> rows_of(InterleavedSettings& interleaved) {
    using settings::Choice;
    using settings::Concerns;
    using settings::Whole;
    using Config = render::InterleavedConfig;
    const settings::OnlyWhile only = only_under({"interleaved"});
    std::vector<std::string> turns;
    turns.reserve(foveation::CellTurns::kEvery.size());
    for (const std::uint32_t every : foveation::CellTurns::kEvery) {
        turns.push_back(fmt::format("{}", every));
    }
    return {
        {"interleaved.disc_every", "each frame shades one of so many pixels of the disc",
         Choice{.value = &interleaved.disc_every, .names = turns}, Concerns::Picture, only},
        {"interleaved.every", "each frame shades one of so many texels; the others are kept",
         Choice{.value = &interleaved.every, .names = turns}, Concerns::Picture, only},
        {"interleaved.follow", "what is kept follows the view and the gaze; else it stays in place",
         &interleaved.follow, Concerns::Picture, only},
        {"interleaved.hold",
         "hold what is kept to what is shaded around it, where that is not what it was",
         &interleaved.hold, Concerns::Picture, only},
        {"interleaved.jitter", "move the samples of a texel from visit to visit",
         &interleaved.jitter, Concerns::Picture, only},
        {"interleaved.refill", "shade all at once where nothing of use is kept",
         &interleaved.refill, Concerns::Picture, only},
        {"interleaved.sharp", "what of the kept is resampled by a spline, not bilinearly",
         Choice{.value = &interleaved.sharp,
                .names = {Config::kSharpNames.begin(), Config::kSharpNames.end()}},
         Concerns::Picture, only},
        {"interleaved.visits", "most visits that a texel's radiance is the mean of",
         Whole{&interleaved.visits, 1, Config::kMostVisits}, Concerns::Picture, only},
    };
}

}  // namespace gazeloop::methods
