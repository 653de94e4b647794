#include <memory>

#include "runtime/cli/people_options.h"
#include "runtime/cli/study_commands.h"
#include "runtime/study/tell_published.h"

namespace gazeloop::cli {

void add_study_published(Command parent) {
    const auto command = std::make_shared<study::PublishedRequest>();
    const auto people = std::make_shared<PeopleOptions>();
    Command app = parent.command(
        "published", "the papers' results beside those of people who see by the contrast metric");
    app.option("trades", command->trades, "what trade --json has found for a study's levels")
        .required()
        .type("FILE...");
    people->add_terms_to(app);
    app.option("--json", command->json, "write the result as JSON; without a file, to stdout")
        .file_or_stdout();
    app.does([=] {
        command->people = people->question;
        study::tell_published(*command);
        return ExitCode::Ok;
    });
}

}  // namespace gazeloop::cli
