#include "runtime/cli/people_options.h"

namespace gazeloop::cli {

void PeopleOptions::add_to(Command app) {
    app.option("--threshold", question.thresholds,
               "level at which a difference is just called one (the middle of the plan's); "
               "repeated: one per condition")
        .type("LEVEL");
    app.option("--width", question.width, "how far from there, in ln level, none is left (0.4)")
        .number_between(1e-3, 100.0);
    app.option("--trade", question.trade,
               "what trade --json has found for the plan's levels: people see as the contrast "
               "metric does, in place of --threshold and --width")
        .type("FILE");
    add_terms_to(app);
}

void PeopleOptions::add_terms_to(Command app) {
    app.option("--noise", question.people.terms.noise,
               "of what is felt, in just noticeable ones (0.5)")
        .number_between(0.0, 100.0);
    app.option("--bias", question.people.terms.bias, "towards what came second (0)")
        .number_between(-10.0, 10.0);
    app.option("--lapse", question.people.terms.lapse, "share of blind answers (0.02)")
        .number_between(0.0, 1.0);
    app.option("--fatigue", question.people.terms.fatigue,
               "growth of noise and criterion per hour (0)")
        .number_between(0.0, 100.0);
    app.option("--people", question.people.terms.people,
               "how much people's thresholds differ, in ln level (0.1)")
        .number_between(0.0, 10.0);
    app.option("--people-seed", question.people.seed, "another one, other people (1)");
}

}  // namespace gazeloop::cli
