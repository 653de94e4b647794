
#include <array>
#include <memory>
#include <string>

#include "runtime/cli/commands.h"
#include "runtime/cli/run_options.h"
#include "runtime/numerics/envelope_html.h"
#include "runtime/numerics/envelope_json.h"
#include "runtime/numerics/envelope_text.h"
#include "runtime/report/output_file.h"
#include "runtime/vulkan/context.h"

namespace gazeloop::cli {
namespace {

struct NumericsCommand {
    LogOptions log;
    numerics::EnvelopeOptions options;
    std::string device;
    std::string html;
    std::string json;
};

ExitCode measure(const NumericsCommand& command) {
    const std::array<report::NamedFile, 2> outputs{
        {{"--json", command.json}, {"--html", command.html}}};
    value_or_throw(report::check_outputs(outputs, {}));
    const vulkan::Context context({.validation = false, .device = command.device}, nullptr);
    const numerics::Envelope envelope = numerics::measure_envelope(context, command.options);
    if (command.json != "-" && command.html != "-" && !command.log.quiet) {
        value_or_throw(report::write_text("-", numerics::envelope_text(envelope)));
    }
    if (!command.json.empty()) {
        value_or_throw(report::write_text(command.json, numerics::envelope_json(envelope)));
    }
    if (!command.html.empty()) {
        value_or_throw(report::write_text(command.html, numerics::envelope_html(envelope)));
    }
    return envelope.met() ? ExitCode::Ok : ExitCode::GateFailed;
}

}  // namespace

void add_numerics_command(Command program) {
    Command app = program.command(
        "numerics", "how exact every map is on this device; exit code 1 if a target is missed");
    const auto command = std::make_shared<NumericsCommand>();
    app.flag("--quick", command->options.quick, "one picture size, fewer maps and draws");
    app.option("--seed", command->options.seed, "of the random probes");
    app.option("--device", command->device, "part of the Vulkan device's name").type("NAME");
    app.option("--html", command->html, "also write a page with plots; - is stdout").type("FILE");
    app.option("--json", command->json, "also write every figure as JSON; - is stdout")
        .type("FILE");
    command->log.add_to(app);
    app.does([=] {
        command->log.apply();
        return measure(*command);
    });
}

}  // namespace gazeloop::cli
