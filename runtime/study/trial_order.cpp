#include "runtime/study/trial_order.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "runtime/study/decisions.h"
#include "sim/random.h"

namespace gazeloop::study {
namespace {

using sim::Random;
using sim::Stream;

std::size_t below(Random& random, std::size_t end) {
    // uniform() is less than 1 by 2^-53, so that the product rounds to `end` for none below 2^52.
    return static_cast<std::size_t>(random.uniform() * static_cast<double>(end));
}

template <typename T>
void shuffle(std::vector<T>& list, Random& random) {
    for (std::size_t left = list.size(); left > 1; --left) {
        std::swap(list[left - 1], list[below(random, left)]);
    }
}

/// Of a factor that has one level in a session: rows of the square over subjects, and each row's
/// levels in turns over sessions.
double level_of_session(const Factor& factor, unsigned subject, unsigned session) {
    const std::size_t count = factor.levels.size();
    return factor.levels[williams_row(count, subject - 1)[session % count]];
}

/// What is shown once in a session; levels of factors by session are the first ones.
struct Item {
    std::vector<double> levels;
    bool reference_first = true;
};

std::vector<Item> items_of(const Plan& plan) {
    std::vector<Item> items;
    const bool both_orders = plan.design == Design::Pair || plan.design == Design::Ramp;
    const bool own_level = adaptive(plan.design);
    const std::size_t count = own_level ? plan.conditions() : plan.cells();
    const auto of_other_session = [&plan](const std::vector<double>& levels) {
        for (std::size_t at = 0; at < levels.size(); ++at) {
            const Factor& factor = plan.factors[at];
            if (factor.by_session && levels[at] != factor.levels.front()) {
                return true;
            }
        }
        return false;
    };
    for (unsigned repeat = 0; repeat < plan.repeats; ++repeat) {
        for (std::size_t cell = 0; cell < count; ++cell) {
            Item item{.levels = plan.levels_of(cell)};
            if (of_other_session(item.levels)) {
                continue;
            }
            if (own_level) {
                item.levels.front() = std::numeric_limits<double>::quiet_NaN();
            }
            items.push_back(item);
            if (both_orders) {
                item.reference_first = false;
                items.push_back(item);
            }
        }
    }
    return items;
}

enum Purpose : std::uint64_t { kSymbols = 0, kTraining = 1, kSession = 2 };

}  // namespace

std::vector<std::size_t> williams_row(std::size_t items, std::size_t row) {
    const std::size_t rows = items % 2 == 0 ? items : 2 * items;
    row %= std::max<std::size_t>(rows, 1);
    std::vector<std::size_t> list(items);
    for (std::size_t place = 0; place < items; ++place) {
        // 0, 1, n - 1, 2, n - 2, ...
        const std::size_t first = place % 2 == 1 ? (place + 1) / 2 : (items - place / 2) % items;
        list[place] = (first + row) % items;
    }
    if (row >= items) {
        std::ranges::reverse(list);
    }
    return list;
}

std::vector<Trial> trials_of(const Plan& plan, unsigned subject) {
    std::vector<Item> items = items_of(plan);
    // Which item is which symbol of the square is chance, and the same for all subjects.
    Random symbols(plan.seed, Stream::StudyOrder, kSymbols);
    shuffle(items, symbols);
    const bool random_order = plan.design == Design::SameDifferent || plan.design == Design::Quest;
    std::vector<Trial> trials;
    const auto add = [&](Trial trial) {
        for (std::size_t at = 0; at < trial.levels.size(); ++at) {
            if (plan.factors[at].by_session) {
                trial.levels[at] = level_of_session(plan.factors[at], subject, trial.session);
            }
        }
        trial.number = static_cast<unsigned>(trials.size());
        trials.push_back(std::move(trial));
    };
    Random training(plan.seed, Stream::StudyOrder, (std::uint64_t{subject} << 20U) + kTraining);
    for (unsigned i = 0; i < plan.training; ++i) {
        const Item& item = items[below(training, items.size())];
        add({.kind = TrialKind::Training,
             .levels = item.levels,
             .reference_first = random_order ? training.uniform() < 0.5 : item.reference_first});
    }
    for (unsigned session = 0; session < plan.sessions; ++session) {
        Random random(plan.seed, Stream::StudyOrder,
                      (std::uint64_t{subject} << 20U) + kSession + session);
        const std::size_t row = std::size_t{subject - 1} * plan.sessions + session;
        std::vector<Trial> list;
        for (const std::size_t symbol : williams_row(items.size(), row)) {
            list.push_back({.session = session,
                            .levels = items[symbol].levels,
                            .reference_first = random_order
                                                   ? (row / items.size() + row + symbol) % 2 == 0
                                                   : items[symbol].reference_first});
        }
        // So many that they are the planned share of all.
        const auto validations = static_cast<std::size_t>(std::llround(
            static_cast<double>(list.size()) * plan.validation / (1.0 - plan.validation)));
        std::vector<bool> validation(list.size() + validations, false);
        std::fill_n(validation.begin(), validations, true);
        for (std::size_t left = validation.size(); left > 1; --left) {
            const std::size_t other = below(random, left);
            const bool kept = validation[left - 1];
            validation[left - 1] = validation[other];
            validation[other] = kept;
        }
        auto next = list.begin();
        for (const bool is_validation : validation) {
            if (is_validation) {
                // A scene that only validation trials have would give them away.
                add({.session = session,
                     .kind = TrialKind::Validation,
                     .levels = plan.reference_varies() ? plan.levels_of(below(random, plan.cells()))
                                                       : std::vector<double>{}});
            } else {
                add(std::move(*next++));
            }
        }
    }
    return trials;
}

}  // namespace gazeloop::study
