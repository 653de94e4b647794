#include "runtime/governor/front_file.h"

#include <fmt/core.h>
#include <toml++/toml.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "config/built_in_files.h"
#include "runtime/open_for_reading.h"
#include "runtime/settings/nearest_name.h"

namespace gazeloop::governor {
namespace {

constexpr std::string_view kFolder = "governor";

std::unexpected<Error> refuse(const std::string& file, std::size_t line, std::string_view what) {
    return std::unexpected(Error{ErrorKind::BadInput, fmt::format("{}:{}: {}", file, line, what)});
}

std::size_t line_of(const toml::node& node) { return node.source().begin.line; }

/// Keys that are there and not known.
Expected<void> refuse_others(const std::string& file, const toml::table& table,
                             const std::vector<std::string>& known) {
    for (const auto& [key, node] : table) {
        const std::string name(key.str());
        if (std::ranges::find(known, name) == known.end()) {
            return refuse(file, line_of(node), settings::unknown_name("key", name, known));
        }
    }
    return {};
}

Expected<Level> read_level(const std::string& file, const toml::table& table) {
    if (auto checked = refuse_others(file, table, {"loss", "method", "ms", "set"}); !checked) {
        return std::unexpected(checked.error());
    }
    const auto method = table["method"].value<std::string>();
    const auto ms = table["ms"].value<double>();
    const auto loss = table["loss"].value<double>();
    if (!method || !ms || !loss) {
        return refuse(file, line_of(table),
                      "a [[level]] needs method = \"NAME\", ms = NUMBER and loss = NUMBER");
    }
    const auto set = table["set"];
    if (set && !set.is_string()) {
        return refuse(file, line_of(*set.node()), "set: \"KEY=VALUE KEY=VALUE\" is needed");
    }
    auto settings = parse_level_settings(set.value_or(std::string_view()));
    if (!settings) {
        return refuse(file, line_of(*set.node()), settings.error().message);
    }
    return Level{.method = *method, .settings = std::move(*settings), .ms = *ms, .loss = *loss};
}

Expected<Front> read_front(const std::string& file, const toml::table& table) {
    if (auto checked = refuse_others(file, table, {"figure", "level"}); !checked) {
        return std::unexpected(checked.error());
    }
    Front front{.figure = table["figure"].value_or(std::string())};
    std::vector<std::size_t> lines;
    const toml::array* const levels = table["level"].as_array();
    if (levels == nullptr) {
        return refuse(file, 1,
                      "a front needs its levels as [[level]] (gazeloop trade --front makes "
                      "such a file)");
    }
    for (const toml::node& node : *levels) {
        const toml::table* const one = node.as_table();
        if (one == nullptr) {
            return refuse(file, line_of(node), "a level is a table: [[level]]");
        }
        auto level = read_level(file, *one);
        if (!level) {
            return std::unexpected(level.error());
        }
        front.levels.push_back(std::move(*level));
        lines.push_back(line_of(*one));
    }
    if (const auto fault = fault_of(front)) {
        return refuse(file, fault->level < lines.size() ? lines[fault->level] : 1, fault->message);
    }
    return front;
}

Expected<Front> parse(const std::string& file, std::string_view text) {
    try {
        return read_front(file, toml::parse(text, file));
    } catch (const toml::parse_error& error) {
        return refuse(file, error.source().begin.line, error.description());
    }
}

}  // namespace

Expected<Front> load_front(std::string_view name) {
    if (name.ends_with(".toml")) {
        const auto in = open_for_reading(name);
        if (!in) {
            return std::unexpected(Error{
                ErrorKind::BadInput,
                fmt::format("{}: the governor's front cannot be read ({})", name, in.error())});
        }
        std::ostringstream text;
        text << in->rdbuf();
        return parse(std::string(name), text.str());
    }
    std::vector<std::string> names;
    for (const config::BuiltInFile& file : config::built_in_files()) {
        if (file.folder != kFolder) {
            continue;
        }
        if (file.name == name) {
            return parse(fmt::format("config/{}/{}.toml", kFolder, name), file.text);
        }
        names.emplace_back(file.name);
    }
    return std::unexpected(Error{ErrorKind::Usage, settings::unknown_name("front", name, names)});
}

std::string front_file(const Front& front, std::string_view made_by) {
    std::string text;
    std::istringstream lines{std::string(made_by)};
    for (std::string line; std::getline(lines, line);) {
        text += fmt::format("# {}\n", line);
    }
    text += fmt::format("figure = \"{}\"\n", front.figure);
    for (const Level& level : front.levels) {
        std::string set = level.text().substr(level.method.size());
        set.erase(0, set.find_first_not_of(' '));
        text += fmt::format("\n[[level]]\nmethod = \"{}\"\n", level.method);
        text += set.empty() ? "" : fmt::format("set = \"{}\"\n", set);
        text += fmt::format("ms = {:.6g}\nloss = {:.6g}\n", level.ms, level.loss);
    }
    return text;
}

}  // namespace gazeloop::governor
