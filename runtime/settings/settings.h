#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "runtime/error.h"
#include "runtime/named_value.h"
#include "sim/gaze_simulation.h"

namespace gazeloop::settings {

/// Everything that can be configured, with its built-in value. Keys are the names below with their
/// group: kfr.sigma, gaze.hold_ms ...
struct SettingValues {
    struct {
        double mar = 0.022;
        double pixels_per_degree = 0.0;
        std::int64_t lp_width = 0;
        std::int64_t lp_height = 0;
        bool disc = true;
        double border_px = 6.0;
        double luminance_cd_m2 = 100.0;
        bool nasal = false;
    } acuity;
    struct {
        double stale_ms = 100.0;
        double hold_ms = 300.0;
        double return_ms = 150.0;
        double minimum_confidence = 0.6;
        double fixation_distance_m = 1.5;
        bool fixation_from_depth = true;
    } gaze;
    struct {
        double eye_distance_m = 0.063;
        double screen_height_m = 0.0;
        double screen_width_m = 0.0;
        double viewing_distance_m = 0.0;
    } hid;
    struct {
        double sigma = 1.8;
        std::string kernel = "power";
        double alpha = 4.0;
        std::string polynomial = "1";
        std::string kernel_samples;
        std::string kernel_table;
        std::int64_t lp_width = 0;
        std::int64_t lp_height = 0;
        bool disc = true;
        bool close_hole = false;
        double border_px = 6.0;
    } kfr;
    struct {
        std::int64_t n = 3;
        bool s2_fixed = false;
        double outer_weight = 1.0;
    } layers;
    struct {
        double inner_deg = 0.0;
        double outer_deg = 0.0;
        std::int64_t tile_px = 16;
    } rings;
    struct {
        double share = 0.1;
        double disc_share = 0.25;
        double narrow_share = 0.4;
        double narrow_spread = 0.1;
        double wide_spread = 0.3;
        std::string placement = "gaussian";
    } sparse;
    struct {
        std::string method = "kfr";
        std::string scene = "raymarch";
        std::int64_t spp = 1;
        double scale = 1.0;
        bool profile = true;
        bool depth = true;
        bool hidden_area = true;
        std::int64_t frames_in_flight = 2;
    } render;
    struct {
        std::string name = "openxr";
        bool validation = false;
    } target;
    struct {
        std::string device;
        bool validation = false;
    } vulkan;
    struct {
        std::string display = "fove0";
        std::string tracker = "generic";
    } profile;
    sim::GazeSimulation sim;
    struct {
        double gpu_ms = 8.0;
    } virtual_time;
};

/// The settings in force, key by key, each with where its value came from.
class Settings {
  public:
    Settings();
    Settings(const Settings&) = delete;
    Settings& operator=(const Settings&) = delete;
    ~Settings() = default;

    /// How a value is written: bare on the command line, or as TOML's kinds.
    enum class Written { Bare, Text, Number, Whole, Flag, Group };

    [[nodiscard]] const SettingValues& values() const { return values_; }

    /// Sets a key from text. Errors (Usage): unknown key (nearest one named), not a value of its
    /// kind, out of range; `origin` ("--set", "FILE:LINE") is part of the message.
    Expected<void> set(std::string_view key, std::string_view text, std::string_view origin);

    /// Sets a key that still has its built-in value, as set() does; leaves any other alone.
    Expected<void> set_default(std::string_view key, std::string_view text,
                               std::string_view origin);

    /// Sets all keys of a TOML file, which must give each value in its kind. A relative path in it
    /// starts at the file's folder. Errors: BadInput if it cannot be read or parsed (line named),
    /// else as set().
    Expected<void> load(const std::filesystem::path& file);

    /// /etc/gazeloop/config.toml and $XDG_CONFIG_HOME/gazeloop/config.toml, in the order in which
    /// they count.
    [[nodiscard]] static std::vector<std::filesystem::path> standard_files();

    /// Whether a standard file is to be loaded: also one that cannot be read, which is an error.
    [[nodiscard]] static bool is_there(const std::filesystem::path& file);

    /// Loads the standard files that are there.
    Expected<void> load_standard_files();

    /// Whether the settings fit together. Errors (Usage): which two do not, and what would.
    [[nodiscard]] Expected<void> check() const;

    /// Whether nobody has set a key.
    [[nodiscard]] bool is_built_in(std::string_view key) const { return origin(key) == kBuiltIn; }

    /// Where a key's value comes from: "FILE:LINE", "--set", a flag or "built-in".
    [[nodiscard]] const std::string& origin(std::string_view key) const;

    /// What came of a key's value; an error with the place where that was set and the key in front,
    /// as it is where nobody has set it.
    template <typename T>
    [[nodiscard]] Expected<T> at_origin(std::string_view key, Expected<T> result) const {
        if (!result) {
            return std::unexpected(at_origin(key, result.error()));
        }
        return result;
    }

    /// Key and value of every setting, in the order of the keys.
    [[nodiscard]] std::vector<NamedValue> list() const;

    /// A table of keys, values, origins and meanings: TOML, and so a configuration again.
    [[nodiscard]] std::string describe() const;

  private:
    static constexpr std::string_view kBuiltIn = "built-in";

    struct Number {
        double* value;
        double least;
        double greatest;
    };
    struct Whole {
        std::int64_t* value;
        std::int64_t least;
        std::int64_t greatest;
    };
    struct Seed {
        std::uint64_t* value;
    };
    struct Choice {
        std::string* value;
        std::vector<std::string> names;  ///< empty: any text
    };
    /// A file, or the name of something built in, which does not end in the extension.
    struct Path {
        std::string* value;
        std::string_view extension;  ///< empty: always a file

        [[nodiscard]] bool is_file(std::string_view text) const {
            return !text.empty() && text.ends_with(extension);
        }
    };
    struct Entry {
        std::string key;
        std::string meaning;
        std::variant<Number, Whole, bool*, Seed, Choice, Path> slot;
        std::string origin{kBuiltIn};
    };

    /// Relative paths start at `folder`.
    Expected<void> assign(std::string_view key, std::string_view text, Written written,
                          std::string_view origin, const std::filesystem::path& folder);
    [[nodiscard]] static std::string text(const Entry& entry);
    [[nodiscard]] const Entry& entry(std::string_view key) const;
    [[nodiscard]] Error at_origin(std::string_view key, const Error& error) const;
    [[nodiscard]] std::string with_origin(std::string_view key) const;
    [[nodiscard]] std::vector<std::string> keys() const;

    SettingValues values_;
    std::vector<Entry> entries_;
};

}  // namespace gazeloop::settings
