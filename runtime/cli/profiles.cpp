#include "runtime/cli/profiles.h"

#include <fmt/core.h>
#include <toml++/toml.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <span>
#include <sstream>

#include "config/built_in_files.h"
#include "runtime/cli/nearest_name.h"

namespace gazeloop::cli {
namespace {

constexpr double kGreatestAngleDeg = 85.0;

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
        std::ifstream in{std::string(name)};
        std::error_code ignored;
        if (!in || std::filesystem::is_directory(std::string(name), ignored)) {
            return std::unexpected(Error{
                ExitCode::BadInput, fmt::format("{}: the {} profile cannot be read", name, what)});
        }
        std::ostringstream text;
        text << in.rdbuf();
        return ProfileText{std::string(name), text.str()};
    }
    for (const config::BuiltInFile& file : config::built_in_files()) {
        if (file.folder == folder && file.name == name) {
            return ProfileText{fmt::format("config/{}/{}.toml", folder, name),
                               std::string(file.text)};
        }
    }
    const std::vector<std::string> names = built_in_names(folder);
    return std::unexpected(Error{ExitCode::Usage, unknown_name(what, name, names)});
}

struct Profile {
    std::string origin;
    toml::table table;
};

Expected<Profile> parse(const ProfileText& profile) {
    try {
        return Profile{profile.origin, toml::parse(profile.text, profile.origin)};
    } catch (const toml::parse_error& error) {
        return std::unexpected(
            Error{ExitCode::BadInput, fmt::format("{}:{}: {}", profile.origin,
                                                  error.source().begin.line, error.description())});
    }
}

Expected<Profile> load(std::string_view folder, std::string_view what, std::string_view name) {
    const auto text = find_text(folder, what, name);
    if (!text) {
        return std::unexpected(text.error());
    }
    return parse(*text);
}

/// Reads numbers and keeps the first complaint.
class NumberReader {
  public:
    NumberReader(const toml::table& table, const std::string& origin)
        : table_(table), origin_(origin) {}

    double number(std::string_view path, double least, double greatest) {
        return checked(table_.at_path(path), path, least, greatest);
    }

    gaze::FieldOfView field_of_view(std::string_view path) {
        const toml::array* const angles = table_.at_path(path).as_array();
        if (angles == nullptr || angles->size() != 4) {
            complain(
                fmt::format("{}: four angles in degrees are needed: left, right, up, down", path));
            return {};
        }
        const auto angle = [&](std::size_t i) {
            return checked(toml::node_view<const toml::node>((*angles)[i]), path,
                           -kGreatestAngleDeg, kGreatestAngleDeg) *
                   std::numbers::pi / 180.0;
        };
        const gaze::FieldOfView fov{angle(0), angle(1), angle(2), angle(3)};
        if (!(fov.left_rad < fov.right_rad && fov.down_rad < fov.up_rad)) {
            complain(fmt::format("{}: left must be less than right, and down less than up", path));
        }
        return fov;
    }

    [[nodiscard]] const std::string& complaint() const { return complaint_; }

  private:
    double checked(toml::node_view<const toml::node> node, std::string_view path, double least,
                   double greatest) {
        const auto value = node.value<double>();
        if (!value) {
            complain(fmt::format("{}: a number is needed", path));
            return least;
        }
        if (!(*value >= least && *value <= greatest)) {
            complain(fmt::format("{} = {}: must lie in [{}, {}]", path, *value, least, greatest));
            return least;
        }
        return *value;
    }

    void complain(const std::string& what) {
        if (complaint_.empty()) {
            complaint_ = fmt::format("{}: {}", origin_, what);
        }
    }

    const toml::table& table_;
    std::string origin_;
    std::string complaint_;
};

std::int64_t ms_to_ns(double ms) { return std::llround(ms * 1e6); }

}  // namespace

Expected<present::DisplayProfile> load_display(std::string_view name) {
    const auto profile = load("displays", "display", name);
    if (!profile) {
        return std::unexpected(profile.error());
    }
    NumberReader read(profile->table, profile->origin);
    present::DisplayProfile display;
    display.name = name;
    display.description = profile->table.at_path("description").value_or(std::string());
    display.width_px = static_cast<std::uint32_t>(read.number("width_px", 2, 16384));
    display.height_px = static_cast<std::uint32_t>(read.number("height_px", 2, 16384));
    display.refresh_hz = read.number("refresh_hz", 1, 2000);
    display.fov = {read.field_of_view("fov_deg.left"), read.field_of_view("fov_deg.right")};
    display.ipd_m = read.number("optics.ipd_mm", 0, 200) * 1e-3;
    display.switching_ns = ms_to_ns(read.number("photons.switching_ms", 0, 1000));
    if (!read.complaint().empty()) {
        return std::unexpected(Error{ExitCode::BadInput, read.complaint()});
    }
    for (const gaze::FieldOfView& fov : display.fov) {
        if (!gaze::is_valid(
                {.fov = fov, .width_px = display.width_px, .height_px = display.height_px})) {
            return std::unexpected(
                Error{ExitCode::BadInput,
                      fmt::format("{}: fov_deg: too narrow to render for", profile->origin)});
        }
    }
    return display;
}

Expected<TrackerProfile> load_tracker(std::string_view name) {
    const auto profile = load("trackers", "tracker", name);
    if (!profile) {
        return std::unexpected(profile.error());
    }
    NumberReader read(profile->table, profile->origin);
    TrackerProfile tracker{std::string(name),
                           profile->table.at_path("description").value_or(std::string()),
                           ms_to_ns(read.number("delay_ms", 0, 1000))};
    if (!read.complaint().empty()) {
        return std::unexpected(Error{ExitCode::BadInput, read.complaint()});
    }
    return tracker;
}

}  // namespace gazeloop::cli
