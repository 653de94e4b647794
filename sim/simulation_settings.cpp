#include "sim/simulation_settings.h"

#include <fmt/core.h>

namespace gazeloop::sim {

std::vector<settings::SettingRow> rows_of(GazeSimulation& simulation) {
    using settings::Concerns;
    std::vector<settings::SettingRow> rows{{"sim.seed",
                                            "the same seed gives the same simulated gaze",
                                            settings::Seed{&simulation.seed}, Concerns::Input}};
    for (const Term& term : terms_of(simulation)) {
        rows.push_back({fmt::format("sim.{}", term.key), std::string(term.meaning),
                        settings::Number{term.value, term.least, term.greatest}, Concerns::Input});
    }
    return rows;
}

}  // namespace gazeloop::sim
