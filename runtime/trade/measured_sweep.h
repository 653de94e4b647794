#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runtime/trade/sweep.h"

namespace gazeloop::trade {

/// Measures a sweep. With a journal (not empty) it goes on where the file ends, and what is
/// measured is in the file at once. Errors: as begin_record(), SweepJournal::open() and sweep().
Expected<SweepRecord> measured_sweep(const vulkan::Context& context, const SweepQuestion& question,
                                     const std::vector<SweepPoint>& points,
                                     const SweptValues& values, settings::Settings& settings,
                                     const std::filesystem::path& journal, SweepHooks hooks);

/// The journals of a sweep's shards as one record; nothing is measured. `said` is told what they
/// lack. Errors: as read_journal() and merged().
Expected<SweepRecord> merged_sweep(const std::vector<std::string>& journals,
                                   const std::function<void(const std::string&)>& said);

}  // namespace gazeloop::trade
