#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/command_line/command_line.h"
#include "runtime/run/program_settings.h"

namespace gazeloop::run {
struct FrameRunRequest;
}

namespace gazeloop::cli {

/// The options that every command has.
struct LogOptions {
    std::string log_level = "info";
    bool quiet = false;

    void add_to(Command command);
    void apply() const;
};

/// The options that `run` and `replay` share.
struct RunOptions {
    LogOptions log;
    std::vector<std::string> config_files;
    std::vector<std::string> assignments;  ///< --set KEY=VALUE
    /// Options that are a setting by another name: the flag, its key, its text if given.
    struct Alias {
        const char* flag;
        const char* key;
        const char* meaning;
        std::string text{};
    };
    std::vector<Alias> aliases{
        {"--target", "target.name", "openxr or headless"},
        {"--scene", "render.scene",
         "scene to render: raymarch, gallery, lightfield, or a .gltf, .glb or .lightfield file"},
        {"--method", "render.method",
         "which samples a picture takes: full, kfr, acuity, layers, rings, sparse, quad, kfr3d, "
         "interleaved, fixed"},
        {"--display", "profile.display", "display profile: a name or a .toml file"},
        {"--budget", "profile.budget", "latency budget: none, a name or a .toml file"},
        {"--sigma", "kfr.sigma", "picture width / LP-buffer width, .5 to 32"},
        {"--alpha", "kfr.alpha", "kernel K(x) = x^alpha, .25 to 16"},
        {"--mar", "acuity.mar", "slope of the MAR line, e.g. .022"},
        {"--seed", "sim.seed", "the same seed gives the same simulated gaze"},
        {"--tracker", "profile.tracker", "tracker profile: a name or a .toml file"},
        {"--spp", "render.spp", "samples per texel or pixel, 1 to 16"},
        {"--axes", "trace.axes", "turn a trace's directions: none, -x, swap-eyes, -z, -x-z"},
    };
    /// Options that switch a setting on: the flag, its key, whether given, what it is set to.
    struct Switch {
        const char* flag;
        const char* key;
        const char* meaning;
        bool given = false;
        const char* text = "true";
    };
    std::vector<Switch> switches{
        {"--accept-repairs", "trace.accept_repairs",
         "read a trace of which much was dropped or changed"},
        {"--governor", "governor.use",
         "keep frames within their budget by moving along a measured front", false, "on"},
    };
    std::optional<std::int64_t> frames;
    std::optional<double> seconds;
    std::string record;
    std::string snapshot;
    std::string json;
    std::optional<std::string> preview;  ///< eyes, if asked for
    bool monitor = false;
    std::optional<unsigned> monitor_json;  ///< a file descriptor
    bool mark_fovea = false;
    bool hash = false;
    bool print_config = false;

    void add_to(Command command);
    /// Of them only those about settings: --config, --set, the aliases and --print-config.
    void add_settings_to(Command command);

    /// Applies --config, --set and the aliases, in this order, and reads the file of a kernel
    /// table. `standard_files`: the user's and the system's configuration first.
    Expected<void> apply_to(run::ProgramSettings& settings, bool standard_files) const;
    /// The same without the file of a kernel table.
    Expected<void> set_in(settings::Settings& settings, bool standard_files) const;

    /// Whether --print-config asked for the settings alone; they have then been printed.
    [[nodiscard]] bool prints(const settings::Settings& settings) const;

    /// Applies them with the standard files and checks what comes of it. False: --print-config
    /// asked for the settings alone. Throws SetupError for what is refused.
    [[nodiscard]] bool settle(run::ProgramSettings& settings) const;

    /// What these options say of a run.
    void fill(run::FrameRunRequest& request) const;
};

}  // namespace gazeloop::cli
