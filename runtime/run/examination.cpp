#include "runtime/run/examination.h"

#include <fmt/core.h>

#include <chrono>
#include <cmath>
#include <iterator>
#include <span>

#include "runtime/profiles/profiles_in_force.h"
#include "runtime/report/output_file.h"
#include "runtime/run/gaze_sources.h"
#include "runtime/run/interrupt.h"
#include "runtime/run/run_checks.h"
#include "runtime/version.h"

namespace gazeloop::run {
namespace {

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

/// Whether `run` would take the settings, all of them together.
doctor::Finding check_settings(ProgramSettings& settings) {
    doctor::Finding finding{.check = "configuration.settings",
                            .found = "no setting is at odds with another"};
    try {
        value_or_throw(methods::take_kernel_table(settings.values().methods.kfr, settings));
        value_or_throw(settings.check());
        (void)value_or_throw(
            profiles::simulate_tracker_in_force(settings.values().profile, settings));
        (void)value_or_throw(profiles::display_in_force(settings.values().profile, settings));
        FrameRunRequest request;
        request.settings = &settings;
        check_request(request);
    } catch (const SetupError& error) {
        finding.verdict = doctor::Verdict::Failure;
        finding.found = error.what();
        finding.remedy = "correct it where it was set: gazeloop run --print-config says where";
        finding.stops_loop = true;
    }
    return finding;
}

/// The display's profile, or the one that is built in where that is none.
display::DisplayProfile display_or_default(const ProgramSettings& settings) {
    const auto display = profiles::display_in_force(settings.values().profile, settings);
    return display ? *display
                   : value_or_throw(profiles::load_display(profiles::ProfileSettings().display));
}

/// What the settings say of HID trackers; nothing where they name no tracker.
drivers::hid::HidOptions hid_options_in_force(const ProgramSettings& settings) {
    const auto tracker = profiles::tracker_in_force(settings.values().profile, settings);
    return tracker ? hid_options(*tracker, settings.values()) : drivers::hid::HidOptions{};
}

}  // namespace

doctor::Findings check_configuration(const std::vector<std::string>& files_named,
                                     settings::Settings& settings) {
    doctor::Findings findings;
    const auto files = settings::Settings::standard_files();
    findings.push_back(load_standard_layer(settings, "configuration.system", files.front()));
    if (files.size() > 1) {
        findings.push_back(load_standard_layer(settings, "configuration.user", files.back()));
    }
    for (std::size_t i = 0; i < files_named.size(); ++i) {
        findings.push_back(
            load_layer(settings, fmt::format("configuration.file.{}", i), files_named[i]));
    }
    return findings;
}

std::optional<ErrorKind> examine(const Examination& wanted, ProgramSettings& settings,
                                 doctor::Findings findings) {
    const ProgramValues& values = settings.values();
    findings.push_back(check_settings(settings));
    const display::DisplayProfile display = display_or_default(settings);

    const report::NamedFile output{"--json", wanted.json};
    value_or_throw(report::check_outputs(std::span{&output, 1}, report::files_of(settings)));
    const auto add = [&](doctor::Findings more) {
        std::ranges::move(more, std::back_inserter(findings));
    };
    const doctor::ProbeLimits limits{
        .patience = std::chrono::milliseconds(std::llround(wanted.patience_s * 1e3)),
        .stop = interrupted};
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
    add(doctor::check_hid({.options = hid_options_in_force(settings), .stop = interrupted}));
    add(doctor::check_clocks(wanted.root));
    add(doctor::check_scheduling(wanted.root));
    add(doctor::check_recording_folder(wanted.folder));
    if (interrupted()) {
        return ErrorKind::Interrupted;
    }
    if (!wanted.json.empty()) {
        nlohmann::json report = doctor::findings_json(findings);
        report["program"] = fmt::format("gazeloop {}", kVersion);
        report["target"] = values.target.name;
        value_or_throw(report::write_text(
            wanted.json,
            report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n"));
    }
    if (wanted.json != "-") {
        fmt::print("{}", doctor::findings_text(findings));
    }
    return doctor::loop_can_run(findings) ? std::nullopt : std::optional(ErrorKind::NoDevice);
}

}  // namespace gazeloop::run
