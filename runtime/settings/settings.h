#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <ranges>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/error.h"
#include "runtime/named_value.h"
#include "runtime/settings/setting_row.h"

namespace gazeloop::settings {

/// The settings in force, key by key, each with where its value came from. The values lie with
/// whoever added their rows.
class Settings {
  public:
    Settings() = default;
    Settings(const Settings&) = delete;
    Settings& operator=(const Settings&) = delete;
    ~Settings() = default;

    /// How a value is written: bare on the command line, or as TOML's kinds.
    enum class Written { Bare, Text, Number, Whole, Flag, Group };

    /// More settings. Their values, built in until now, must outlive this. Preconditions: no key is
    /// there twice; the setting that a row depends on is there before is_in_use() is called.
    void add(const std::vector<SettingRow>& rows);

    /// From here on, keys of groups of which there is no setting are another program's: set() and
    /// load() pass them over. Unknown keys of known groups stay errors.
    void pass_over_other_groups() { other_groups_pass_ = true; }

    /// All of them, in the order of the keys.
    [[nodiscard]] auto rows() const {
        return entries_ | std::views::values | std::views::transform(&Entry::row);
    }

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

    /// Whether nobody has set a key.
    [[nodiscard]] bool is_built_in(std::string_view key) const { return origin(key) == kBuiltIn; }

    /// Whether a setting has any effect, by the values in force.
    [[nodiscard]] bool is_in_use(const SettingRow& row) const;

    /// Where a key's value comes from: "FILE:LINE", "--set", a flag or "built-in".
    [[nodiscard]] const std::string& origin(std::string_view key) const;

    /// "KEY = VALUE (ORIGIN)".
    [[nodiscard]] std::string with_origin(std::string_view key) const;

    /// A result that came of a key's value. If it is an error, the place where the key was set, and
    /// the key, are put in front; unless nobody has set the key.
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

    struct Entry {
        SettingRow row;
        std::string origin{kBuiltIn};
    };

    /// Relative paths start at `folder`.
    Expected<void> assign(std::string_view key, std::string_view text, Written written,
                          std::string_view origin, const std::filesystem::path& folder);
    [[nodiscard]] const Entry& entry(std::string_view key) const;
    [[nodiscard]] Error at_origin(std::string_view key, const Error& error) const;
    [[nodiscard]] std::vector<std::string> keys() const;

    /// Whether there is a setting GROUP.NAME.
    [[nodiscard]] bool has_group(std::string_view group) const;

    std::map<std::string, Entry, std::less<>> entries_;
    bool other_groups_pass_ = false;
};

/// "KEY = VALUE" as TOML writes it: a line of a configuration.
[[nodiscard]] std::string toml_line(const SettingRow& row);

/// A setting's value, as set() takes it.
[[nodiscard]] std::string text_of(const SettingRow& row);

}  // namespace gazeloop::settings
