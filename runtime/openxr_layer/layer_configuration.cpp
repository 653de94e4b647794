#include "runtime/openxr_layer/layer_configuration.h"

#include <fmt/format.h>

#include <map>
#include <mutex>
#include <utility>

#include "drivers/anatomy/anatomy_source.h"
#include "drivers/calibrated/calibrated_source.h"
#include "drivers/device/last_words.h"
#include "drivers/simulated/ahead_source.h"
#include "runtime/calibration/calibration_file.h"
#include "runtime/calibration/calibration_settings.h"
#include "runtime/environment.h"
#include "runtime/openxr_layer/layer_log.h"
#include "runtime/openxr_layer/user_folders.h"
#include "runtime/profiles/profiles_in_force.h"
#include "runtime/time/milliseconds.h"
#include "sim/simulation_settings.h"

namespace gazeloop::openxr_layer {
namespace {

void add_rows(settings::Settings& settings, LayerValues& values) {
    // By name, so that none is forgotten.
    auto& [gaze, hid, layer, profile, sim, steam_frame, trace] = values;
    settings.add(rows_of(gaze));
    settings.add(rows_of(hid));
    settings.add(rows_of(layer));
    settings.add(rows_of(profile));
    settings.add(rows_of(sim));
    settings.add(rows_of(steam_frame));
    settings.add(rows_of(trace));
}

/// KEY=VALUE; `origin` is where it stands.
Expected<void> set_assignment(settings::Settings& settings, std::string_view assignment,
                              std::string_view origin) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string_view::npos) {
        return std::unexpected(Error{
            ErrorKind::Usage, fmt::format("{}: '{}': KEY=VALUE is expected", origin, assignment)});
    }
    return settings.set(assignment.substr(0, equals), assignment.substr(equals + 1), origin);
}

Expected<void> set_lines(settings::Settings& settings, std::string_view lines) {
    while (!lines.empty()) {
        const std::size_t end = std::min(lines.find('\n'), lines.size());
        const std::string_view line = lines.substr(0, end);
        lines.remove_prefix(std::min(end + 1, lines.size()));
        if (line.empty()) {
            continue;
        }
        if (auto set = set_assignment(settings, line, kSettingsVariable); !set) {
            return set;
        }
    }
    return {};
}

/// Of the file or of the values; read without a word, since the log is somebody else's.
Expected<std::optional<calibration::Calibration>> calibration_of(
    const gaze::GazeSettings& gaze, const settings::Settings& settings) {
    if (gaze.calibration.empty()) {
        return calibration::calibration_in_force(gaze.calibration_values, settings);
    }
    auto read =
        settings.at_origin("gaze.calibration", calibration::read_calibration(gaze.calibration));
    if (!read) {
        return std::unexpected(std::move(read.error()));
    }
    return read->calibration;
}

Expected<void> load_into(settings::Settings& settings, LayerConfiguration& configuration) {
    LayerValues& values = configuration.values;
    if (auto loaded = settings.load_standard_files(); !loaded) {
        return loaded;
    }
    if (const auto own = layer_config_file(); own && settings::Settings::is_there(*own)) {
        if (auto loaded = settings.load(*own); !loaded) {
            return loaded;
        }
    }
    if (auto set = set_lines(settings, environment_value(kSettingsVariable).value_or("")); !set) {
        return set;
    }
    if (auto set = run::default_tracker(values.layer.gaze, settings); !set) {
        return set;
    }
    auto tracker = profiles::simulate_tracker_in_force(values.profile, settings);
    if (!tracker) {
        return std::unexpected(std::move(tracker.error()));
    }
    configuration.tracker = std::move(*tracker);
    auto corrected = calibration_of(values.gaze, settings);
    if (!corrected) {
        return std::unexpected(std::move(corrected.error()));
    }
    configuration.calibration = *corrected;
    return gaze::check(values.gaze, settings);
}

HistoryPolicy policy_of(const gaze::GazeSettings& gaze) {
    HistoryPolicy policy{.minimum_confidence = gaze.minimum_confidence,
                         .stale_ns = time::ms_to_ns(gaze.stale_ms),
                         .hold_ns = time::ms_to_ns(gaze.hold_ms),
                         .motion = gaze::fovea_policy(gaze).motion};
    policy.motion.tell_events = gaze.events;
    policy.motion.predict = false;  // applications are told what was seen
    return policy;
}

/// A simulated person takes time that a tracker's driver does not: it is not the application's.
run::MakeSource computed_ahead(run::MakeSource make) {
    return [make = std::move(make)](std::int64_t start_ns) {
        return std::make_unique<drivers::AheadSource>(make(start_ns));
    };
}

/// As in a run: live directions are held against anatomy, and corrected where they can be.
run::MakeSource dressed(run::MakeSource make, bool live,
                        std::optional<calibration::Calibration> calibration) {
    return [make = std::move(make), live, calibration](std::int64_t start_ns) {
        auto source = make(start_ns);
        if (live) {
            source = std::make_unique<drivers::AnatomySource>(std::move(source));
        }
        if (calibration && !source->fixed_in_head()) {
            source = std::make_unique<drivers::CalibratedSource>(std::move(source), *calibration);
        }
        return source;
    };
}

Expected<run::MakeSource> source_of(const LayerValues& values,
                                    const profiles::TrackerProfile& tracker) {
    const std::string& name = values.layer.gaze;
    if (name == "openxr") {
        return std::unexpected(Error{
            ErrorKind::Usage,
            "layer.gaze = 'openxr': the layer cannot take its gaze from openxr, which is what "
            "it gives gaze to: name hid, psvr2, steam-frame, osc:PORT, trace:FILE, "
            "fixed:AZ,EL or sim"});
    }
    auto make = run::gaze_source_named(name, tracker, values);
    if (!make) {
        return std::unexpected(Error{
            make.error().kind, fmt::format("layer.gaze = '{}': {}", name, make.error().message)});
    }
    return make;
}

}  // namespace

std::optional<std::filesystem::path> layer_config_file() {
    auto folder = user_config();
    return folder ? std::optional(*folder / "gazeloop/layer.toml") : std::nullopt;
}

Expected<std::string> settings_file(const std::vector<std::string>& assignments) {
    LayerValues values;
    settings::Settings settings;
    add_rows(settings, values);
    for (const std::string& assignment : assignments) {
        if (auto set = set_assignment(settings, assignment, "--set"); !set) {
            return std::unexpected(std::move(set.error()));
        }
    }
    if (!values.layer.gaze.empty()) {
        // Of which tracker is not known yet, and matters to no source's being there.
        if (auto source = source_of(values, {}); !source) {
            return std::unexpected(std::move(source.error()));
        }
    }
    std::string text;
    for (const settings::SettingRow& row : settings.rows()) {
        if (!settings.is_built_in(row.key)) {
            text += settings::toml_line(row) + "\n";
        }
    }
    return text;
}

Expected<LayerConfiguration> load_configuration() {
    LayerConfiguration configuration;
    settings::Settings settings;
    settings.pass_over_other_groups();
    add_rows(settings, configuration.values);
    if (auto loaded = load_into(settings, configuration); !loaded) {
        return std::unexpected(std::move(loaded.error()));
    }
    configuration.list = settings.list();
    return configuration;
}

Expected<void> check_gaze(const LayerConfiguration& configuration) {
    if (configuration.values.layer.gaze.empty()) {
        return {};
    }
    auto source = source_of(configuration.values, configuration.tracker);
    return source ? Expected<void>() : std::unexpected(std::move(source.error()));
}

Expected<std::shared_ptr<GazeFeed>> open_feed(const LayerConfiguration& configuration) {
    static std::mutex mutex;
    struct Open {
        std::weak_ptr<GazeFeed> feed;
        bool events = false;
    };
    static std::map<std::string, Open> feeds;
    const LayerValues& values = configuration.values;
    const std::string& name = values.layer.gaze;
    if (name.empty()) {
        return nullptr;
    }
    const std::lock_guard lock(mutex);
    Open& known = feeds[name];
    if (auto open = known.feed.lock()) {
        if (values.gaze.events && !known.events) {
            say(LogLevel::Info, fmt::format("{} is read already, without what the eyes do: events "
                                            "of its samples are unknown here",
                                            name));
        }
        return open;
    }
    drivers::set_last_words([](std::string_view line) noexcept { say(LogLevel::Warning, line); });
    auto make = source_of(values, configuration.tracker);
    if (!make) {
        return std::unexpected(std::move(make.error()));
    }
    if (name == "sim") {
        *make = computed_ahead(std::move(*make));
    }
    auto feed = std::make_shared<GazeFeed>(
        name, dressed(std::move(*make), run::is_device(name), configuration.calibration),
        policy_of(values.gaze));
    known = {feed, values.gaze.events};
    return feed;
}

}  // namespace gazeloop::openxr_layer
