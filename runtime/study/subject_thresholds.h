#pragma once

#include <optional>
#include <span>
#include <vector>

#include "runtime/study/plan.h"
#include "runtime/study/trial.h"

namespace gazeloop::study {

/// Which combination of all factors but the first: as Plan::levels_of counts cells.
[[nodiscard]] std::size_t condition_of(const Plan& plan, const Trial& trial);

/// One subject's threshold in one condition by the papers' own rules. Pair: the lowest level that
/// was ever called as good as the reference, or better. Ramp: the lowest whose change was not seen,
/// or the wrong way. Slider: the mean of the levels at which it was first stopped. The studies of
/// pairs that ask for "same" have no such rule; theirs here: the level furthest from the reference
/// of whose answers at least the plan's criterion were "same". "Lowest" means furthest from the
/// reference. None: there is no such level, or no valid answer.
[[nodiscard]] std::optional<double> subject_threshold(const Plan& plan,
                                                      std::span<const Response> of_subject,
                                                      std::size_t condition);

}  // namespace gazeloop::study
