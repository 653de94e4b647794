#include "runtime/cli/run_options.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

namespace gazeloop::cli {

void CommonOptions::add_to(CLI::App& command) {
    command.add_option("--config", config_files, "TOML file with settings; may be repeated")
        ->type_name("FILE");
    command.add_option("--set", assignments, "a setting, e.g. kfr.disc=false; may be repeated")
        ->type_name("KEY=VALUE");
    command.add_option("--log-level", log_level, "what goes to stderr")
        ->check(CLI::IsMember({"trace", "debug", "info", "warn", "error", "off"}));
    command.add_flag("--quiet", quiet, "no log below warnings, no summary");
}

void CommonOptions::apply_log_level() const {
    spdlog::set_level(quiet && log_level == "info" ? spdlog::level::warn
                                                   : spdlog::level::from_str(log_level));
}

void RunOptions::add_to(CLI::App& command) {
    common.add_to(command);
    for (Alias& alias : aliases) {
        command.add_option(alias.flag, alias.text,
                           fmt::format("{} ({})", alias.meaning, alias.key));
    }
    command.add_option("--frames", frames, "end after N frames")->type_name("N");
    command.add_option("--seconds", seconds, "end after S seconds")
        ->type_name("S")
        ->check(CLI::NonNegativeNumber);
    command.add_option("--record", record, "write a session (must not exist yet)")
        ->type_name("FILE");
    command.add_option("--snapshot", snapshot, "write pictures of the last frame")
        ->type_name("DIR");
    command.add_flag("--mark-fovea", mark_fovea, "draw the fovea into the snapshot");
    command.add_flag("--hash", hash, "hash every frame's foveae and pixels");
    command.add_option("--json", json, "write the summary as JSON; - is stdout")->type_name("FILE");
    command.add_flag("--print-config", print_config, "show every setting and where it comes from");
}

Expected<void> RunOptions::apply_to(Settings& settings, bool standard_files) const {
    if (standard_files) {
        if (auto loaded = settings.load_standard_files(); !loaded) {
            return loaded;
        }
    }
    for (const std::string& file : common.config_files) {
        if (auto loaded = settings.load(file); !loaded) {
            return loaded;
        }
    }
    for (const std::string& assignment : common.assignments) {
        const std::size_t equals = assignment.find('=');
        if (equals == std::string::npos) {
            return std::unexpected(
                Error{ExitCode::Usage, fmt::format("--set {}: KEY=VALUE is expected", assignment)});
        }
        if (auto set =
                settings.set(assignment.substr(0, equals), assignment.substr(equals + 1), "--set");
            !set) {
            return set;
        }
    }
    for (const Alias& alias : aliases) {
        if (!alias.text.empty()) {
            if (auto set = settings.set(alias.key, alias.text, alias.flag); !set) {
                return set;
            }
        }
    }
    return {};
}

void RunOptions::fill(FrameRunRequest& request) const {
    const auto path = [](const std::string& text) {
        return text.empty() ? std::nullopt : std::optional<std::filesystem::path>(text);
    };
    request.loop.frames = frames;
    request.loop.seconds = seconds;
    request.record = path(record);
    request.snapshot = path(snapshot);
    request.json = path(json);
    request.mark_fovea = mark_fovea;
    request.hash = hash;
    request.quiet = common.quiet;
}

}  // namespace gazeloop::cli
