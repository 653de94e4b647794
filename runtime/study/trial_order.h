#pragma once

#include <vector>

#include "runtime/study/plan.h"
#include "runtime/study/trial.h"

namespace gazeloop::study {

/// Row `row` of a Latin square in which, over its rows, each item is at each place once and follows
/// each other once (Williams 1949): n rows for an even number of items, 2 n for an odd one. Rows
/// beyond begin again. Precondition: items > 0.
[[nodiscard]] std::vector<std::size_t> williams_row(std::size_t items, std::size_t row);

/// All trials of a subject (from 1), session by session, the training first. The same for the same
/// plan and subject on every machine. Each session's items stand in the row of the square that is
/// next over subjects and sessions; items are what is shown once in a session: cells, for Pair and
/// Ramp in both orders; of a Slider the conditions; of Quest the conditions in turns, since their
/// levels are not planned. For SameDifferent an item's order changes from row to row. Validation
/// trials lie anywhere between. Precondition: check(plan).
[[nodiscard]] std::vector<Trial> trials_of(const Plan& plan, unsigned subject);

}  // namespace gazeloop::study
