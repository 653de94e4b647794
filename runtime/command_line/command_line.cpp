#include "runtime/command_line/command_line.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <sstream>
#include <utility>

#include "runtime/settings/nearest_name.h"

namespace gazeloop::cli {
namespace {

/// The whole text as a number; none if it is not one.
template <typename Number>
std::optional<Number> number_in(const std::string& text) {
    Number value{};
    const char* const end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data(), end, value);
    return error == std::errc{} && stopped == end ? std::optional(value) : std::nullopt;
}

/// CLI11 does not say which word it could not place.
std::optional<std::string> unknown_command(const CLI::App& program,
                                           const std::vector<std::string>& words) {
    const std::vector<const CLI::App*> commands = program.get_subcommands({});
    if (commands.empty() || words.empty() || words.front().starts_with('-')) {
        return std::nullopt;
    }
    std::vector<std::string> known;
    for (const CLI::App* const command : commands) {
        if (command->get_name() == words.front()) {
            return std::nullopt;
        }
        if (!command->get_group().empty()) {  // what has none is the program's own
            known.push_back(command->get_name());
        }
    }
    return settings::unknown_name("command", words.front(), known);
}

/// Of what was left over after parsing; CLI11 lists it from the end, without saying what is near.
std::string unexpected_word(const CLI::App& program, const std::vector<std::string>& words) {
    const CLI::App* command = &program;
    std::string name = program.get_name();
    while (!command->get_subcommands().empty()) {
        command = command->get_subcommands().front();
        name += " " + command->get_name();
    }
    std::vector<std::string> known;
    for (const CLI::Option* const option : command->get_options()) {
        for (const std::string& one : option->get_lnames()) {
            known.push_back("--" + one);
        }
    }
    const std::string help = fmt::format("{} --help lists what there is", name);
    for (const std::string& given : words) {
        const std::string word = given.substr(0, given.find('='));
        if (word.starts_with("--") && std::ranges::find(known, word) == known.end()) {
            const auto nearest = settings::nearest_name(word, known);
            return fmt::format("unknown option '{}'{}; {}", word,
                               nearest ? fmt::format("; did you mean '{}'?", *nearest) : "", help);
        }
    }
    const std::vector<std::string> left = command->remaining();
    return fmt::format("'{}' was not expected; {}", left.empty() ? "" : left.front(), help);
}

/// Of an option that takes one value and stands there several times; CLI11 tells only how many
/// values it had.
std::optional<std::string> given_twice(const CLI::App& program) {
    const CLI::App* command = &program;
    while (!command->get_subcommands().empty()) {
        command = command->get_subcommands().front();
    }
    for (const CLI::Option* const option : command->get_options()) {
        const std::vector<std::string>& values = option->results();
        if (values.size() > 1 && option->get_items_expected_max() == 1) {
            return fmt::format("{}: it is given {} times ({}): leave one", option->get_name(),
                               values.size(), fmt::join(values, ", "));
        }
    }
    return std::nullopt;
}

}  // namespace

Option& Option::type(const std::string& name) {
    option_->type_name(name);
    return *this;
}

Option& Option::number_between(double least, double greatest) {
    return check([least, greatest](const std::string& text) {
        const auto value = number_in<double>(text);
        return value && *value >= least && *value <= greatest
                   ? std::string()
                   : fmt::format("'{}' must be a number in [{}, {}]", text, least, greatest);
    });
}

Option& Option::whole_number(std::uint64_t greatest) {
    return check([greatest](const std::string& text) {
        const auto value = number_in<std::uint64_t>(text);
        return value && *value <= greatest
                   ? std::string()
                   : fmt::format("'{}' must be a whole number, at most {}", text, greatest);
    });
}

Option& Option::one_of(const std::vector<std::string>& names) {
    option_->check(CLI::IsMember(names));
    return *this;
}

Option& Option::not_empty() {
    return check([](const std::string& text) {
        return text.empty() ? std::string("a name is needed") : std::string();
    });
}

Option& Option::check(std::function<std::string(const std::string&)> refusal) {
    option_->check(CLI::Validator(std::move(refusal), ""));
    return *this;
}

Option& Option::required() {
    option_->required();
    return *this;
}

Option& Option::value_optional(const std::string& value) {
    option_->expected(0, 1)->default_str(value);
    return *this;
}

Option& Option::only_with(const Option& other) {
    option_->needs(other.option_);
    return *this;
}

Option& Option::not_with(const Option& other) {
    option_->excludes(other.option_);
    return *this;
}

Option& Option::hidden() {
    option_->group("");
    return *this;
}

bool Option::given() const { return option_->count() > 0; }

Command Command::command(const std::string& name, const std::string& meaning) {
    return {app_->add_subcommand(name, meaning), chosen_};
}

template <typename Value>
Option Command::option(const std::string& name, Value& value, const std::string& meaning) {
    CLI::Option* const option = app_->add_option(name, value, meaning);
    if constexpr (std::is_same_v<Value, std::vector<std::string>>) {
        // An option takes one each time; a positional all that are left.
        option->allow_extra_args(!name.starts_with('-'));
    }
    return Option(option);
}

template Option Command::option(const std::string&, std::string&, const std::string&);
template Option Command::option(const std::string&, double&, const std::string&);
template Option Command::option(const std::string&, unsigned&, const std::string&);
template Option Command::option(const std::string&, std::uint64_t&, const std::string&);
template Option Command::option(const std::string&, std::vector<std::string>&, const std::string&);
template Option Command::option(const std::string&, std::optional<std::string>&,
                                const std::string&);
template Option Command::option(const std::string&, std::optional<std::int64_t>&,
                                const std::string&);
template Option Command::option(const std::string&, std::optional<unsigned>&, const std::string&);
template Option Command::option(const std::string&, std::optional<double>&, const std::string&);

Option Command::flag(const std::string& name, bool& value, const std::string& meaning) {
    return Option(app_->add_flag(name, value, meaning));
}

void Command::does(Action action) {
    app_->callback([chosen = chosen_, action = std::move(action)] { *chosen = action; });
}

void Command::hide() { app_->group(""); }

void Command::require_command() { app_->require_subcommand(1); }

ExitCode say(const Reply& reply) {
    fmt::print(reply.code == ExitCode::Ok ? stdout : stderr, "{}", reply.text);
    return reply.code;
}

CommandLine::CommandLine(const std::string& name, const std::string& meaning)
    : app_(std::make_unique<CLI::App>(meaning, name)) {}

CommandLine::~CommandLine() = default;

Command CommandLine::program() { return {app_.get(), &chosen_}; }

void CommandLine::set_version(const std::string& text) {
    app_->set_version_flag("--version", text);
}

std::expected<Action, Reply> CommandLine::parse(const std::vector<std::string>& words) {
    if (const auto refusal = unknown_command(*app_, words)) {
        throw SetupError(ErrorKind::Usage, *refusal);
    }
    try {
        app_->parse(std::vector<std::string>(words.rbegin(), words.rend()));  // as CLI11 takes them
        return chosen_;
    } catch (const CLI::ExtrasError&) {
        throw SetupError(ErrorKind::Usage, unexpected_word(*app_, words));
    } catch (const CLI::ParseError& error) {
        const auto twice =
            error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ArgumentMismatch)
                ? given_twice(*app_)
                : std::nullopt;
        if (twice) {
            throw SetupError(ErrorKind::Usage, *twice);
        }
        std::ostringstream text;
        const bool asked = app_->exit(error, text, text) == 0;
        return std::unexpected(Reply{asked ? ExitCode::Ok : ExitCode::Usage, text.str()});
    }
}

}  // namespace gazeloop::cli
