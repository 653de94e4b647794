#include "runtime/profiles/profiles.h"

#include <fmt/core.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <sstream>

#include "config/built_in_files.h"
#include "runtime/open_for_reading.h"
#include "runtime/settings/nearest_name.h"
#include "runtime/time/milliseconds.h"
#include "sim/gaze_simulation.h"

namespace gazeloop::profiles {
namespace {

constexpr double kGreatestAngleDeg = 85.0;
constexpr double kGreatestCantDeg = 45.0;

/// A profile's text, by name or from a file.
struct ProfileText {
    std::string origin;  ///< for messages
    std::string text;
};

std::vector<std::string> built_in_names(std::string_view folder) {
    std::vector<std::string> names;
    for (const config::BuiltInFile& file : config::built_in_files()) {
        if (file.folder == folder) {
            names.emplace_back(file.name);
        }
    }
    return names;
}

Expected<ProfileText> find_text(std::string_view folder, std::string_view what,
                                std::string_view name) {
    if (name.ends_with(".toml")) {
        const auto in = open_for_reading(name);
        if (!in) {
            return std::unexpected(Error{
                ErrorKind::BadInput,
                fmt::format("{}: the {} profile cannot be read ({})", name, what, in.error())});
        }
        std::ostringstream text;
        text << in->rdbuf();
        return ProfileText{std::string(name), text.str()};
    }
    if (name.find('/') != std::string_view::npos) {
        return std::unexpected(Error{
            ErrorKind::Usage,
            fmt::format("'{}': the name of a {} profile's file must end in .toml", name, what)});
    }
    for (const config::BuiltInFile& file : config::built_in_files()) {
        if (file.folder == folder && file.name == name) {
            return ProfileText{fmt::format("config/{}/{}.toml", folder, name),
                               std::string(file.text)};
        }
    }
    const std::vector<std::string> names = built_in_names(folder);
    return std::unexpected(Error{ErrorKind::Usage, settings::unknown_name(what, name, names)});
}

struct Profile {
    std::string origin;
    toml::table table;
};

Expected<Profile> parse(const ProfileText& profile) {
    try {
        return Profile{profile.origin, toml::parse(profile.text, profile.origin)};
    } catch (const toml::parse_error& error) {
        return std::unexpected(Error{
            ErrorKind::BadInput, fmt::format("{}:{}: {}", profile.origin, error.source().begin.line,
                                             error.description())});
    }
}

Expected<Profile> load(std::string_view folder, std::string_view what, std::string_view name) {
    const auto text = find_text(folder, what, name);
    if (!text) {
        return std::unexpected(text.error());
    }
    return parse(*text);
}

/// Reads the figures of a profile and keeps the first complaint.
class ProfileReader {
  public:
    explicit ProfileReader(const Profile& profile)
        : table_(profile.table), origin_(profile.origin) {}

    double number(const std::string& path, double least, double greatest) {
        known_.push_back(path);
        return checked(table_.at_path(path), path, least, greatest);
    }

    std::optional<double> optional_number(const std::string& path, double least, double greatest) {
        known_.push_back(path);
        if (!table_.at_path(path)) {
            return std::nullopt;
        }
        return checked(table_.at_path(path), path, least, greatest);
    }

    std::optional<std::int64_t> optional_ms(const std::string& path, double least = 0) {
        const auto ms = optional_number(path, least, 1000);
        return ms ? std::optional(time::ms_to_ns(*ms)) : std::nullopt;
    }

    std::optional<std::string> optional_text(const std::string& path) {
        known_.push_back(path);
        const auto node = table_.at_path(path);
        if (node && !node.is_string()) {
            complain(node.node(), fmt::format("{}: text is needed", path));
        }
        return node.value<std::string>();
    }

    std::optional<display::Illumination> optional_illumination(const std::string& path) {
        const auto text = optional_text(path);
        const std::vector<std::string> names{"global", "rolling"};
        if (!text || *text == names[0]) {
            return text ? std::optional(display::Illumination::Global) : std::nullopt;
        }
        if (*text != names[1]) {
            complain(table_.at_path(path).node(), settings::unknown_name(path, *text, names));
        }
        return display::Illumination::Rolling;
    }

    gaze::FieldOfView field_of_view(const std::string& path) {
        const std::vector<double> angles_rad =
            angles(path, 4, kGreatestAngleDeg, "left, right, up, down");
        const gaze::FieldOfView fov{angles_rad[0], angles_rad[1], angles_rad[2], angles_rad[3]};
        if (!(fov.left_rad < fov.right_rad && fov.down_rad < fov.up_rad)) {
            complain(table_.at_path(path).node(),
                     fmt::format("{}: left must be less than right, and down less than up", path));
        }
        return fov;
    }

    gaze::PerEye<double> optional_angles_per_eye(const std::string& path, double greatest_deg) {
        if (!table_.at_path(path)) {
            known_.push_back(path);
            return {};
        }
        const std::vector<double> angles_rad = angles(path, 2, greatest_deg, "left eye, right eye");
        return {angles_rad[0], angles_rad[1]};
    }

    /// Keys of figures that the profile has.
    std::vector<std::string> optional_keys(const std::string& path) {
        known_.push_back(path);
        std::vector<std::string> keys;
        const toml::array* const list = table_.at_path(path).as_array();
        if (list == nullptr) {
            if (const auto node = table_.at_path(path)) {
                complain(node.node(), fmt::format("{}: a list of keys is needed", path));
            }
            return keys;
        }
        for (const toml::node& node : *list) {
            const std::string key = node.value_or(std::string());
            if (key.empty() || !table_.at_path(key)) {
                complain(&node, fmt::format("{}: '{}' is no key of this profile", path, key));
            }
            keys.push_back(key);
        }
        return keys;
    }

    /// Complains of a key's value as a whole.
    void refuse(const std::string& path, std::string_view why) {
        complain(table_.at_path(path).node(), fmt::format("{}: {}", path, why));
    }

    /// Complains of a number that is not there.
    void miss(const std::string& path) {
        complain(nullptr, fmt::format("{}: a number is needed", path));
    }

    /// After all figures were read: refuses the rest.
    void refuse_others() { refuse_others(table_, ""); }

    [[nodiscard]] const std::string& complaint() const { return complaint_; }

  private:
    std::vector<double> angles(const std::string& path, std::size_t count, double greatest_deg,
                               std::string_view order) {
        known_.push_back(path);
        std::vector<double> angles_rad(count, 0.0);
        const auto node = table_.at_path(path);
        const toml::array* const list = node.as_array();
        if (list == nullptr || list->size() != count) {
            complain(node.node(),
                     fmt::format("{}: {} angles in degrees are needed: {}", path, count, order));
            return angles_rad;
        }
        for (std::size_t i = 0; i < count; ++i) {
            angles_rad[i] = checked(toml::node_view<const toml::node>((*list)[i]), path,
                                    -greatest_deg, greatest_deg) *
                            std::numbers::pi / 180.0;
        }
        return angles_rad;
    }

    double checked(toml::node_view<const toml::node> node, std::string_view path, double least,
                   double greatest) {
        const auto value = node.value<double>();
        if (!value) {
            complain(node.node(), fmt::format("{}: a number is needed", path));
            return least;
        }
        if (!(*value >= least && *value <= greatest)) {
            complain(node.node(),
                     fmt::format("{} = {}: must lie in [{}, {}]", path, *value, least, greatest));
            return least;
        }
        return *value;
    }

    void refuse_others(const toml::table& table, const std::string& prefix) {
        for (const auto& [name, node] : table) {
            const std::string key = prefix + std::string(name.str());
            if (const toml::table* const inner = node.as_table()) {
                refuse_others(*inner, key + ".");
            } else if (std::ranges::find(known_, key) == known_.end()) {
                complain(&node, settings::unknown_name("key", key, known_));
            }
        }
    }

    void complain(const toml::node* node, const std::string& what) {
        if (complaint_.empty()) {
            complaint_ = node != nullptr
                             ? fmt::format("{}:{}: {}", origin_, node->source().begin.line, what)
                             : fmt::format("{}: {}", origin_, what);
        }
    }

    const toml::table& table_;
    std::string origin_;
    std::vector<std::string> known_;
    std::string complaint_;
};

}  // namespace

Expected<display::DisplayProfile> load_display(std::string_view name) {
    const auto profile = load("displays", "display", name);
    if (!profile) {
        return std::unexpected(profile.error());
    }
    ProfileReader read(*profile);
    display::DisplayProfile display;
    display.name = name;
    display.description = read.optional_text("description").value_or("");
    display.width_px = static_cast<std::uint32_t>(read.number("width_px", 2, 16384));
    display.height_px = static_cast<std::uint32_t>(read.number("height_px", 2, 16384));
    display.refresh_hz = read.number("refresh_hz", 1, 2000);
    display.fov = {read.field_of_view("fov_deg.left"), read.field_of_view("fov_deg.right")};
    display.ipd_m = read.number("optics.ipd_mm", 0, 200) * 1e-3;
    display.cant_outward_rad =
        read.optional_angles_per_eye("optics.cant_outward_deg", kGreatestCantDeg);
    display.illumination = read.optional_illumination("photons.illumination");
    display.persistence_ns = read.optional_ms("photons.persistence_ms");
    display.scan_out_ns = read.optional_ms("photons.scan_out_ms");
    display.switching_ns = read.optional_ms("photons.switching_ms");
    display.assumed = read.optional_keys("assumed");
    read.refuse_others();
    if (!read.complaint().empty()) {
        return std::unexpected(Error{ErrorKind::BadInput, read.complaint()});
    }
    for (const gaze::FieldOfView& fov : display.fov) {
        if (!gaze::is_valid(
                {.fov = fov, .width_px = display.width_px, .height_px = display.height_px})) {
            return std::unexpected(
                Error{ErrorKind::BadInput,
                      fmt::format("{}: fov_deg: too narrow to render for", profile->origin)});
        }
    }
    const auto longer_than_frame = [&](const std::optional<std::int64_t>& ns) {
        return ns && *ns > display.period_ns();
    };
    if (longer_than_frame(display.persistence_ns) || longer_than_frame(display.scan_out_ns)) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("{}: photons: persistence_ms and scan_out_ms must not exceed the "
                              "period of {} Hz",
                              profile->origin, display.refresh_hz)});
    }
    return display;
}

Expected<TrackerProfile> load_tracker(std::string_view name) {
    const auto profile = load("trackers", "tracker", name);
    if (!profile) {
        return std::unexpected(profile.error());
    }
    ProfileReader read(*profile);
    TrackerProfile tracker;
    tracker.name = name;
    tracker.description = read.optional_text("description").value_or("");
    sim::GazeSimulation simulation;
    for (const sim::Term& term : sim::terms_of(simulation)) {
        if (!term.of_tracker) {
            continue;
        }
        const std::string key(term.key);
        if (const auto value = read.optional_number(key, term.least, term.greatest)) {
            tracker.terms.emplace_back(key, *value);
        }
    }
    const auto delay =
        std::ranges::find(tracker.terms, "delay_ms", &std::pair<std::string, double>::first);
    if (delay != tracker.terms.end()) {
        tracker.delay_ns = time::ms_to_ns(delay->second);
        // Where nobody has said how sure it is, nothing better than the delay itself can be said.
        tracker.delay_uncertainty_ns = time::ms_to_ns(
            read.optional_number("delay_uncertainty_ms", 0, 1000).value_or(delay->second));
    } else {
        read.miss("delay_ms");
    }
    tracker.assumed = read.optional_keys("assumed");
    read.refuse_others();
    if (!read.complaint().empty()) {
        return std::unexpected(Error{ErrorKind::BadInput, read.complaint()});
    }
    return tracker;
}

Expected<latency::LatencyBudget> load_budget(std::string_view name) {
    constexpr double kLeast_ms = 0.001;
    const auto profile = load("budgets", "budget", name);
    if (!profile) {
        return std::unexpected(profile.error());
    }
    ProfileReader read(*profile);
    latency::LatencyBudget budget;
    budget.name = name;
    budget.description = read.optional_text("description").value_or("");
    budget.source = read.optional_text("source").value_or("");
    budget.total_ns = read.optional_ms("total_ms", kLeast_ms);
    bool any = budget.total_ns.has_value();
    for (std::size_t stage = 0; stage < latency::kStageCount; ++stage) {
        const std::string key = fmt::format("stages_ms.{}", latency::kStageKeys[stage]);
        budget.stages_ns[stage] = read.optional_ms(key, kLeast_ms);
        any = any || budget.stages_ns[stage];
        if (budget.total_ns && budget.stages_ns[stage] > budget.total_ns) {
            read.refuse(key, "must not be above total_ms");
        }
    }
    read.refuse_others();
    if (!any && read.complaint().empty()) {
        return std::unexpected(Error{
            ErrorKind::BadInput,
            fmt::format("{}: a budget needs total_ms, or a limit of a stage under [stages_ms]",
                        profile->origin)});
    }
    if (!read.complaint().empty()) {
        return std::unexpected(Error{ErrorKind::BadInput, read.complaint()});
    }
    return budget;
}

}  // namespace gazeloop::profiles
