#include <fmt/core.h>

#include <chrono>
#include <cmath>
#include <iterator>
#include <memory>

#include "runtime/cli/commands.h"
#include "runtime/cli/run_options.h"
#include "runtime/doctor/checks.h"
#include "runtime/profiles/profiles_in_force.h"
#include "runtime/report/output_file.h"
#include "runtime/run/gaze_sources.h"
#include "runtime/run/interrupt.h"
#include "runtime/run/run_checks.h"
#include "runtime/version.h"

namespace gazeloop::cli {
namespace {

struct DoctorCommand {
    RunOptions options;  ///< of which those of the settings are offered
    std::string folder = ".";
    std::string root = "/";
    double patience_s = 20.0;
    std::string json;
};

doctor::Finding load_layer(settings::Settings& settings, const std::string& check,
                           const std::filesystem::path& file) {
    doctor::Finding finding{.check = check, .facts = {{"file", file.string()}}};
    if (const auto loaded = settings.load(file)) {
        finding.found = file.string() + " is in force";
    } else {
        finding.verdict = doctor::Verdict::Failure;
        finding.found = loaded.error().message;
        finding.remedy = "correct what it names, or remove the file";
        finding.stops_loop = true;
    }
    return finding;
}

/// A file that may be missing.
doctor::Finding load_standard_layer(settings::Settings& settings, const std::string& check,
                                    const std::filesystem::path& file) {
    if (settings::Settings::is_there(file)) {
        return load_layer(settings, check, file);
    }
    return {.check = check,
            .verdict = doctor::Verdict::NotApplicable,
            .found = file.string() + " is not there",
            .facts = {{"file", file.string()}}};
}

/// Loads every layer that is there and can be loaded, in order.
doctor::Findings check_configuration(const DoctorCommand& command, settings::Settings& settings) {
    doctor::Findings findings;
    const auto files = settings::Settings::standard_files();
    findings.push_back(load_standard_layer(settings, "configuration.system", files.front()));
    if (files.size() > 1) {
        findings.push_back(load_standard_layer(settings, "configuration.user", files.back()));
    }
    for (std::size_t i = 0; i < command.options.config_files.size(); ++i) {
        findings.push_back(load_layer(settings, fmt::format("configuration.file.{}", i),
                                      command.options.config_files[i]));
    }
    return findings;
}

/// Whether `run` would take the settings, all of them together.
doctor::Finding check_settings(run::ProgramSettings& settings) {
    doctor::Finding finding{.check = "configuration.settings",
                            .found = "no setting is at odds with another"};
    try {
        value_or_throw(methods::take_kernel_table(settings.values().methods.kfr, settings));
        value_or_throw(settings.check());
        (void)value_or_throw(
            profiles::simulate_tracker_in_force(settings.values().profile, settings));
        (void)value_or_throw(profiles::display_in_force(settings.values().profile, settings));
        run::FrameRunRequest request;
        request.settings = &settings;
        run::check_request(request);
    } catch (const SetupError& error) {
        finding.verdict = doctor::Verdict::Failure;
        finding.found = error.what();
        finding.remedy = "correct it where it was set: gazeloop run --print-config says where";
        finding.stops_loop = true;
    }
    return finding;
}

/// The display's profile, or the one that is built in where that is none.
display::DisplayProfile display_or_default(const run::ProgramSettings& settings) {
    const auto display = profiles::display_in_force(settings.values().profile, settings);
    return display ? *display
                   : value_or_throw(profiles::load_display(profiles::ProfileSettings().display));
}

/// What the settings say of HID trackers; nothing where they name no tracker.
drivers::hid::HidOptions hid_options_in_force(const run::ProgramSettings& settings) {
    const auto tracker = profiles::tracker_in_force(settings.values().profile, settings);
    return tracker ? run::hid_options(*tracker, settings.values()) : drivers::hid::HidOptions{};
}

ExitCode run_doctor(const DoctorCommand& command) {
    run::ProgramSettings settings;
    doctor::Findings findings = check_configuration(command, settings);
    // The files are loaded already, as far as they can be.
    RunOptions rest = command.options;
    rest.config_files.clear();
    value_or_throw(rest.set_in(settings, false));
    const run::ProgramValues& values = settings.values();
    findings.push_back(check_settings(settings));
    const display::DisplayProfile display = display_or_default(settings);

    if (!command.json.empty()) {
        value_or_throw(report::check_output(command.json));
    }
    const auto add = [&](doctor::Findings more) {
        std::ranges::move(more, std::back_inserter(findings));
    };
    const doctor::ProbeLimits limits{
        .patience = std::chrono::milliseconds(std::llround(command.patience_s * 1e3)),
        .stop = run::interrupted};
    add(doctor::check_vulkan({.device = values.vulkan.device,
                              .device_origin = settings.origin("vulkan.device"),
                              .validation = values.vulkan.validation},
                             limits));
    const bool vulkan_works = std::ranges::any_of(findings, [](const doctor::Finding& finding) {
        return finding.check.starts_with("vulkan.device.") &&
               finding.verdict == doctor::Verdict::Ok;
    });
    add(doctor::check_openxr({.display = display,
                              .scale = values.render.scale,
                              .validation = values.target.validation,
                              .vulkan_works = vulkan_works,
                              .is_target = values.target.name == "openxr"},
                             limits));
    add(doctor::check_hid({.options = hid_options_in_force(settings), .stop = run::interrupted}));
    add(doctor::check_clocks(command.root));
    add(doctor::check_scheduling(command.root));
    add(doctor::check_recording_folder(command.folder));
    if (run::interrupted()) {
        return ExitCode::Interrupted;
    }
    if (!command.json.empty()) {
        nlohmann::json report = doctor::findings_json(findings);
        report["program"] = fmt::format("gazeloop {}", kVersion);
        report["target"] = values.target.name;
        value_or_throw(report::write_text(
            command.json,
            report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n"));
    }
    if (command.json != "-") {
        fmt::print("{}", doctor::findings_text(findings));
    }
    return doctor::loop_can_run(findings) ? ExitCode::Ok : ExitCode::NoDevice;
}

}  // namespace

void add_doctor_command(Command program) {
    Command app = program.command(
        "doctor", "check what the loop needs of this machine; exit code 4: it cannot run");
    const auto command = std::make_shared<DoctorCommand>();
    app.option("--json", command->json, "write it as JSON; without a file, to stdout")
        .value_optional("-")
        .type("[FILE]");
    command->options.log.add_to(app);
    command->options.add_settings_to(app);
    app.option("--folder", command->folder, "where recordings are to go").type("DIR");
    app.option("--patience", command->patience_s,
               "how long a driver or runtime may take before it counts as hanging")
        .type("SECONDS")
        .number_between(0.1, 600.0);
    // Stands in for the machine's /sys and /dev, for tests.
    app.option("--root", command->root, "").hidden();
    app.does([=] {
        command->options.log.apply();
        return run_doctor(*command);
    });
}

}  // namespace gazeloop::cli
