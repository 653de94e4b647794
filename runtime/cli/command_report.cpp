#include <memory>

#include "runtime/cli/commands.h"
#include "runtime/cli/run_options.h"
#include "runtime/session_report/report_session.h"

namespace gazeloop::cli {
namespace {

struct ReportCommand {
    LogOptions log;
    std::string percentiles;
    session_report::ReportRequest request;
};

}  // namespace

void add_report_command(Command program) {
    Command app = program.command("report", "where a session's latency went");
    const auto command = std::make_shared<ReportCommand>();
    app.option("file", command->request.file, "a session written by --record")
        .required()
        .type("SESSION");
    const Option percentiles =
        app.option("--percentiles", command->percentiles,
                   "percents to show, separated by commas (default 50,90,95,99,99.9)")
            .type("LIST");
    app.option("--csv", command->request.csv, "write every frame as a line of CSV; - is stdout")
        .type("FILE");
    app.option("--html", command->request.html,
               "write the report as one page with plots; - is stdout")
        .type("FILE");
    app.option("--json", command->request.json, "write the report as JSON; - is stdout")
        .type("FILE");
    const Option perfetto = app.option("--perfetto", command->request.perfetto,
                                       "write a trace for ui.perfetto.dev; - is stdout")
                                .type("FILE");
    app.option("--perfetto-samples", command->request.perfetto_samples,
               "gaze samples in it: those that frames rested on (used), or all")
        .one_of({"used", "all"})
        .only_with(perfetto);
    app.option("--against", command->request.against,
               "also show what changed since this session, and how much of it is chance")
        .type("SESSION");
    app.option("--probe", command->request.probe,
               "show eye-to-photon as gazeloop probe --video --json FILE measured it beside it")
        .type("FILE")
        .not_empty();
    const Option named =
        app.option("--budget", command->request.budget,
                   "exit code 1 unless the session keeps this budget: a name or a .toml file")
            .type("NAME")
            .not_empty();
    app.option("--budget-ms", command->request.budget_ms,
               "the same with a limit on the gaze age at display alone")
        .type("N")
        .number_between(0.001, 1000)
        .not_with(named);
    app.option("--runtime-metrics", command->request.runtime.metrics,
               "when frames were shown, by monado-service's XRT_METRICS_FILE of the run")
        .type("FILE");
    app.option("--runtime-csv", command->request.runtime.csv,
               "the stages of WiVRn, by its server's WIVRN_DUMP_TIMINGS of the run")
        .type("FILE");
    command->log.add_to(app);
    app.does([=] {
        command->log.apply();
        if (percentiles.given()) {
            command->request.percentiles = command->percentiles;
        }
        command->request.quiet = command->log.quiet;
        session_report::report_session(command->request);
        return ExitCode::Ok;
    });
}

}  // namespace gazeloop::cli
