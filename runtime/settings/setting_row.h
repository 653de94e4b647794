#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace gazeloop::settings {

/// What a setting can change, as far as a replay of a recording must know.
enum class Concerns : std::uint8_t {
    Input,    ///< gaze, views and times as a frame gets them: a recording holds what came of it
    Foveae,   ///< where the foveae are, from that input
    Picture,  ///< the pixels, from views and foveae
    Output,   ///< what else comes out: depth, times, figures of plans
    Machine,  ///< where a run takes place and who watches it: no replay takes it from a recording
};

/// A number in [least, greatest].
struct Number {
    double* value;
    double least;
    double greatest;
};

/// A whole number in [least, greatest].
struct Whole {
    std::int64_t* value;
    std::int64_t least;
    std::int64_t greatest;
};

/// Any whole number that is not negative.
struct Seed {
    std::uint64_t* value;
};

struct Choice {
    std::string* value;
    std::vector<std::string> names{};  ///< empty: any text
    std::string what{};                ///< for messages; empty: the key without its group
    /// A file whose name ends in one of these may be given instead of a name.
    std::vector<std::string_view> file_extensions{};

    [[nodiscard]] bool is_file(std::string_view text) const;
};

/// Numbers with commas between; TOML may give them as an array. Whoever uses them reads them.
struct NumberList {
    std::string* value;
};

/// A file, or the name of something built in, which does not end in the extension.
struct Path {
    std::string* value;
    std::string_view extension;  ///< empty: always a file

    [[nodiscard]] bool is_file(std::string_view text) const {
        return !text.empty() && text.ends_with(extension);
    }
};

using Slot = std::variant<Number, Whole, bool*, Seed, Choice, NumberList, Path>;

/// When a setting has any effect: while the one named `key` has one of these values.
struct OnlyWhile {
    std::string key;  ///< empty: always
    std::vector<std::string> values;
};

/// One setting: its name, GROUP.NAME, and the place of its value, which holds the built-in one.
struct SettingRow {
    std::string key;
    std::string meaning;
    Slot slot;
    Concerns concerns;
    OnlyWhile only_while{};
};

}  // namespace gazeloop::settings
