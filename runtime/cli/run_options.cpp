#include "runtime/cli/run_options.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include "runtime/calibration/calibration_settings.h"
#include "runtime/preview/preview_memory.h"
#include "runtime/preview/preview_window.h"
#include "runtime/run/frame_run.h"
#include "runtime/run/line_writer.h"
#include "runtime/settings/layers.h"

namespace gazeloop::cli {

void LogOptions::add_to(Command command) {
    command.option("--log-level", log_level, "what goes to stderr")
        .one_of({"trace", "debug", "info", "warn", "error", "off"});
    command.flag("--quiet", quiet, "no log below warnings, no summary");
}

void LogOptions::apply() const {
    spdlog::set_level(quiet && log_level == "info" ? spdlog::level::warn
                                                   : spdlog::level::from_str(log_level));
}

void RunOptions::add_to(Command command) {
    log.add_to(command);
    add_settings_to(command);
    command.option("--frames", frames, "end after N frames")
        .type("N")
        .whole_number(1'000'000'000'000'000);
    command.option("--seconds", seconds, "end after S seconds").type("S").number_between(0, 1e9);
    command.option("--record", record, "write a session (must not exist yet)")
        .type("FILE")
        .not_empty();
    const Option pictures =
        command.option("--snapshot", snapshot, "write pictures of the last frame")
            .type("DIR")
            .not_empty();
    command.flag("--mark-fovea", mark_fovea, "draw the fovea into the snapshot")
        .only_with(pictures);
    command.flag("--hash", hash, "hash every frame's foveae and pixels");
    command.option("--json", json, "write the result as JSON; - is stdout")
        .type("FILE")
        .not_empty();
    command
        .option("--preview", preview,
                fmt::format("show the result in a window: left, right or both eyes. Keys: {}",
                            preview::kWindowKeys))
        .type("[left|right|both]")
        .value_optional()
        .check([](const std::string& text) {
            return preview::eyes_named(text) != 0
                       ? std::string()
                       : fmt::format("'{}' must be left, right or both", text);
        });
    command.flag("--monitor", monitor,
                 "where the latency goes while it runs: a panel on stderr, or a line a second "
                 "where that is no terminal");
    command
        .option("--monitor-json", monitor_json,
                "the same as lines of JSON on a file descriptor that is open for writing")
        .type("FD")
        .check([](const std::string& text) { return run::LineWriter::refusal(text); });
}

void RunOptions::add_settings_to(Command command) {
    command.option("--config", config_files, "TOML file with settings; may be repeated")
        .type("FILE");
    command.option("--set", assignments, "a setting, e.g. kfr.disc=false; may be repeated")
        .type("KEY=VALUE");
    for (Alias& alias : aliases) {
        command.option(alias.flag, alias.text, fmt::format("{} ({})", alias.meaning, alias.key))
            .not_empty();
    }
    for (Switch& one : switches) {
        command.flag(one.flag, one.given, fmt::format("{} ({})", one.meaning, one.key));
    }
    command.flag("--print-config", print_config, "show every setting and where it comes from");
}

Expected<void> RunOptions::apply_to(run::ProgramSettings& settings, bool standard_files) const {
    if (auto set = set_in(settings, standard_files); !set) {
        return set;
    }
    if (auto taken = calibration::take_calibration(settings.values().gaze.calibration, settings);
        !taken) {
        return taken;
    }
    return methods::take_kernel_table(settings.values().methods.kfr, settings);
}

Expected<void> RunOptions::set_in(settings::Settings& settings, bool standard_files) const {
    std::vector<settings::NamedAssignment> named;
    for (const Alias& alias : aliases) {
        if (!alias.text.empty()) {
            named.push_back({alias.key, alias.text, alias.flag});
        }
    }
    for (const Switch& one : switches) {
        if (one.given) {
            named.push_back({one.key, one.text, one.flag});
        }
    }
    return settings::apply({standard_files, config_files, assignments, named}, settings);
}

bool RunOptions::prints(const settings::Settings& settings) const {
    if (print_config) {
        fmt::print("{}", settings.describe());
    }
    return print_config;
}

bool RunOptions::settle(run::ProgramSettings& settings) const {
    value_or_throw(apply_to(settings, true));
    if (prints(settings)) {
        return false;
    }
    value_or_throw(settings.check());
    return true;
}

void RunOptions::fill(run::FrameRunRequest& request) const {
    const auto path = [](const std::string& text) {
        return text.empty() ? std::nullopt : std::optional<std::filesystem::path>(text);
    };
    if (frames) {
        request.loop.frames = static_cast<std::uint64_t>(*frames);
    }
    request.loop.seconds = seconds;
    request.record = path(record);
    request.snapshot = path(snapshot);
    request.json = path(json);
    request.preview_eyes = preview ? preview::eyes_named(*preview) : 0;
    request.monitor = monitor;
    request.monitor_json =
        monitor_json ? std::optional(static_cast<int>(*monitor_json)) : std::nullopt;
    request.mark_fovea = mark_fovea;
    request.hash = hash;
    request.quiet = log.quiet;
}

}  // namespace gazeloop::cli
