#include "runtime/settings/settings.h"

#include <fmt/core.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <initializer_list>
#include <limits>
#include <optional>
#include <sstream>
#include <type_traits>

#include "runtime/open_for_reading.h"
#include "runtime/settings/nearest_name.h"

namespace gazeloop::settings {
namespace {

/// A number written in full; an error says what the text is instead.
template <typename T>
std::expected<T, std::string_view> parse_number(std::string_view text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end != text.data() + text.size() || error == std::errc::invalid_argument) {
        return std::unexpected(std::is_integral_v<T> ? "not a whole number" : "not a number");
    }
    if (error != std::errc{}) {
        return std::unexpected("too large or too small a number");
    }
    return value;
}

/// In the order of Settings::Written.
constexpr std::array<std::string_view, 6> kWrittenNames{
    "a bare word", "a text", "a number", "a whole number", "true or false", "a table"};

std::unexpected<Error> refuse(std::string_view origin, std::string message) {
    return std::unexpected(
        Error{ErrorKind::Usage, fmt::format("{}: {}", origin, std::move(message))});
}

/// One line of a TOML file.
struct Assignment {
    std::string key;
    std::string text;
    Settings::Written written = Settings::Written::Bare;
    toml::source_index line = 0;
};

/// None: not one value. `takes_list`: whether a key's value may be an array.
std::optional<Assignment> assignment(std::string key, const toml::node& node,
                                     const auto& takes_list) {
    using Written = Settings::Written;
    const toml::source_index line = node.source().begin.line;
    if (const auto text = node.value_exact<std::string>()) {
        return Assignment{std::move(key), *text, Written::Text, line};
    }
    if (const auto whole = node.value_exact<std::int64_t>()) {
        return Assignment{std::move(key), fmt::format("{}", *whole), Written::Whole, line};
    }
    if (const auto number = node.value_exact<double>()) {
        return Assignment{std::move(key), fmt::format("{}", *number), Written::Number, line};
    }
    if (const auto flag = node.value_exact<bool>()) {
        return Assignment{std::move(key), *flag ? "true" : "false", Written::Flag, line};
    }
    if (const toml::array* const list = node.as_array(); list && takes_list(key)) {
        std::string text;
        for (const toml::node& each : *list) {
            const auto number = each.value<double>();
            if (!number) {
                return std::nullopt;
            }
            text += fmt::format("{}{}", text.empty() ? "" : ",", *number);
        }
        return Assignment{std::move(key), text, Written::Text, line};
    }
    return std::nullopt;
}

/// A table's lines with their full keys. A table without any is a line of its own, so that a
/// misspelt one is noticed.
Expected<void> flatten(const toml::table& table, const std::string& prefix, const std::string& file,
                       const auto& takes_list, std::vector<Assignment>& lines) {
    for (const auto& [name, node] : table) {
        const std::string key = prefix + std::string(name.str());
        if (const toml::table* const inner = node.as_table()) {
            if (inner->empty()) {
                lines.push_back({key, "", Settings::Written::Group, node.source().begin.line});
            } else if (auto flat = flatten(*inner, key + ".", file, takes_list, lines); !flat) {
                return flat;
            }
            continue;
        }
        auto line = assignment(key, node, takes_list);
        if (!line) {
            return refuse(fmt::format("{}:{}", file, node.source().begin.line),
                          fmt::format("{}: one value is expected", key));
        }
        lines.push_back(std::move(*line));
    }
    return {};
}

/// As TOML writes it.
std::string quoted(const std::string& text) {
    std::ostringstream out;
    out << toml::value(text);
    return out.str();
}

std::string toml_value(const SettingRow& row) {
    // A seed may be above what TOML's numbers hold.
    const bool bare = std::holds_alternative<Number>(row.slot) ||
                      std::holds_alternative<Whole>(row.slot) ||
                      std::holds_alternative<bool*>(row.slot);
    return bare ? text_of(row) : quoted(text_of(row));
}

}  // namespace

bool Choice::is_file(std::string_view text) const {
    return std::ranges::any_of(file_extensions, [&](std::string_view extension) {
        return text.size() > extension.size() && text.ends_with(extension);
    });
}

void Settings::add(const std::vector<SettingRow>& rows) {
    for (const SettingRow& row : rows) {
        entries_.emplace(row.key, Entry{.row = row});
    }
}

std::vector<std::string> Settings::keys() const {
    std::vector<std::string> keys;
    keys.reserve(entries_.size());
    for (const SettingRow& row : rows()) {
        keys.push_back(row.key);
    }
    return keys;
}

bool Settings::has_group(std::string_view group) const {
    return std::ranges::any_of(rows(), [&](const SettingRow& row) {
        return row.key.starts_with(std::string(group) + ".");
    });
}

Expected<void> Settings::set(std::string_view key, std::string_view text, std::string_view origin) {
    return assign(key, text, Written::Bare, origin, "");
}

Expected<void> Settings::assign(std::string_view key, std::string_view text, Written written,
                                std::string_view origin, const std::filesystem::path& folder) {
    const auto found = entries_.find(key);
    if (found == entries_.end()) {
        const bool group = written == Written::Group && has_group(key);
        const std::size_t point = std::min(key.find('.'), key.size());
        const bool another = other_groups_pass_ &&
                             (point < key.size() || written == Written::Group) &&
                             !has_group(key.substr(0, point));
        return group || another ? Expected<void>{} : refuse(origin, unknown_key(key, keys()));
    }
    auto& [row, entry_origin] = found->second;
    const auto wrong_kind = [&](std::string_view wanted) {
        return refuse(origin, fmt::format("{}: {} is expected, this is {}", key, wanted,
                                          kWrittenNames[static_cast<std::size_t>(written)]));
    };
    const auto out_of_range = [&](auto least, auto greatest) {
        return refuse(origin,
                      fmt::format("{} = {}: must lie in [{}, {}]", key, text, least, greatest));
    };
    const auto malformed = [&](std::string_view why) {
        return refuse(origin, fmt::format("{} = '{}': {}", key, text, why));
    };
    const auto is = [&](std::initializer_list<Written> kinds) {
        return written == Written::Bare || std::ranges::find(kinds, written) != kinds.end();
    };
    if (Number* const number = std::get_if<Number>(&row.slot)) {
        if (!is({Written::Number, Written::Whole})) {
            return wrong_kind("a number");
        }
        const auto value = parse_number<double>(text);
        if (!value) {
            return malformed(value.error());
        }
        if (!(*value >= number->least && *value <= number->greatest)) {
            return out_of_range(number->least, number->greatest);
        }
        *number->value = *value;
    } else if (Whole* const whole = std::get_if<Whole>(&row.slot)) {
        if (!is({Written::Whole})) {
            return wrong_kind("a whole number");
        }
        const auto value = parse_number<std::int64_t>(text);
        if (!value) {
            return malformed(value.error());
        }
        if (*value < whole->least || *value > whole->greatest) {
            return out_of_range(whole->least, whole->greatest);
        }
        *whole->value = *value;
    } else if (bool** const flag = std::get_if<bool*>(&row.slot)) {
        if (!is({Written::Flag})) {
            return wrong_kind("true or false");
        }
        if (text != "true" && text != "false") {
            return malformed("must be true or false");
        }
        **flag = text == "true";
    } else if (Seed* const seed = std::get_if<Seed>(&row.slot)) {
        const auto value = parse_number<std::uint64_t>(text);
        if (!value) {
            return refuse(origin, fmt::format("{} = '{}': not a whole number from 0 to {}", key,
                                              text, std::numeric_limits<std::uint64_t>::max()));
        }
        *seed->value = *value;
    } else if (!is({Written::Text})) {
        return wrong_kind("a text in quotes");
    } else if (Path* const path = std::get_if<Path>(&row.slot)) {
        *path->value = path->is_file(text) ? (folder / text).string() : std::string(text);
    } else if (NumberList* const list = std::get_if<NumberList>(&row.slot)) {
        *list->value = text;
    } else {
        Choice& choice = std::get<Choice>(row.slot);
        if (choice.is_file(text)) {
            *choice.value = (folder / text).string();
            entry_origin = origin;
            return {};
        }
        if (!choice.names.empty() && std::ranges::find(choice.names, text) == choice.names.end()) {
            std::string what =
                unknown_name(choice.what.empty() ? key.substr(key.find('.') + 1) : choice.what,
                             text, choice.names);
            if (!choice.file_extensions.empty()) {
                what += fmt::format("; or a file whose name ends in {}",
                                    fmt::join(choice.file_extensions, ", "));
            }
            return refuse(origin, what);
        }
        *choice.value = text;
    }
    entry_origin = origin;
    return {};
}

Expected<void> Settings::set_default(std::string_view key, std::string_view text,
                                     std::string_view origin) {
    const auto entry = entries_.find(key);
    return entry != entries_.end() && entry->second.origin != kBuiltIn ? Expected<void>{}
                                                                       : set(key, text, origin);
}

Expected<void> Settings::load(const std::filesystem::path& file) {
    const std::string name = file.string();
    auto in = open_for_reading(file);
    if (!in) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("{}: the configuration cannot be read ({})", name, in.error())});
    }
    const auto takes_list = [this](std::string_view key) {
        const auto entry = entries_.find(key);
        return entry != entries_.end() &&
               std::holds_alternative<NumberList>(entry->second.row.slot);
    };
    std::vector<Assignment> lines;
    try {
        if (auto flat = flatten(toml::parse(*in, name), "", name, takes_list, lines); !flat) {
            return flat;
        }
    } catch (const toml::parse_error& error) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("{}:{}: {}", name, error.source().begin.line, error.description())});
    }
    // The first of several errors is the one that stands first.
    std::ranges::stable_sort(lines, {}, &Assignment::line);
    for (const Assignment& line : lines) {
        if (auto set = assign(line.key, line.text, line.written,
                              fmt::format("{}:{}", name, line.line), file.parent_path());
            !set) {
            return set;
        }
    }
    return {};
}

std::vector<std::filesystem::path> Settings::standard_files() {
    std::vector<std::filesystem::path> folders{"/etc"};
    const char* const config = std::getenv("XDG_CONFIG_HOME");
    // The base directory specification: a relative path there counts as none.
    if (config != nullptr && std::filesystem::path(config).is_absolute()) {
        folders.emplace_back(config);
    } else if (const char* const home = std::getenv("HOME"); home != nullptr && *home != '\0') {
        folders.push_back(std::filesystem::path(home) / ".config");
    }
    for (std::filesystem::path& folder : folders) {
        folder /= "gazeloop/config.toml";
    }
    return folders;
}

bool Settings::is_there(const std::filesystem::path& file) {
    // What may not be looked at, or points nowhere, is there: reading it then says what is wrong.
    std::error_code failure;
    return std::filesystem::symlink_status(file, failure).type() !=
           std::filesystem::file_type::not_found;
}

Expected<void> Settings::load_standard_files() {
    for (const std::filesystem::path& file : standard_files()) {
        if (is_there(file)) {
            if (auto loaded = load(file); !loaded) {
                return loaded;
            }
        }
    }
    return {};
}

bool Settings::is_in_use(const SettingRow& row) const {
    const auto& [key, values] = row.only_while;
    if (key.empty()) {
        return true;
    }
    const SettingRow& decides = entry(key).row;
    return std::ranges::find(values, text_of(decides)) != values.end() && is_in_use(decides);
}

const Settings::Entry& Settings::entry(std::string_view key) const {
    return entries_.find(key)->second;
}

const std::string& Settings::origin(std::string_view key) const { return entry(key).origin; }

Error Settings::at_origin(std::string_view key, const Error& error) const {
    const std::string& place = origin(key);
    return place == kBuiltIn
               ? error
               : Error{error.kind, fmt::format("{}: {}: {}", place, key, error.message)};
}

std::string Settings::with_origin(std::string_view key) const {
    return fmt::format("{} = {} ({})", key, text_of(entry(key).row), origin(key));
}

std::vector<NamedValue> Settings::list() const {
    std::vector<NamedValue> values;
    values.reserve(entries_.size());
    for (const SettingRow& row : rows()) {
        values.push_back({row.key, text_of(row)});
    }
    return values;
}

std::string toml_line(const SettingRow& row) {
    return fmt::format("{} = {}", row.key, toml_value(row));
}

std::string Settings::describe() const {
    std::string table;
    for (const auto& [row, origin] : entries_ | std::views::values) {
        table +=
            fmt::format("{:28} = {:12} # {:9} {}\n", row.key, toml_value(row), origin, row.meaning);
    }
    return table;
}

std::string text_of(const SettingRow& row) {
    if (const auto* const number = std::get_if<Number>(&row.slot)) {
        return fmt::format("{}", *number->value);
    }
    if (const auto* const whole = std::get_if<Whole>(&row.slot)) {
        return fmt::format("{}", *whole->value);
    }
    if (const auto* const seed = std::get_if<Seed>(&row.slot)) {
        return fmt::format("{}", *seed->value);
    }
    if (bool* const* const flag = std::get_if<bool*>(&row.slot)) {
        return **flag ? "true" : "false";
    }
    if (const auto* const path = std::get_if<Path>(&row.slot)) {
        // In full, since what is printed or recorded may be read elsewhere.
        std::error_code no_current_folder;
        const std::filesystem::path full =
            path->is_file(*path->value) ? std::filesystem::absolute(*path->value, no_current_folder)
                                        : std::filesystem::path();
        return full.empty() ? *path->value : full.string();
    }
    if (const auto* const list = std::get_if<NumberList>(&row.slot)) {
        return *list->value;
    }
    return *std::get<Choice>(row.slot).value;
}

}  // namespace gazeloop::settings
