#pragma once

#include <expected>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/command_line/exit_code.h"

// CLI11 takes ten seconds per file to compile: its header stays in command_line.cpp.
namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace gazeloop::cli {

/// What a chosen command does; throws SetupError for what it refuses.
using Action = std::function<ExitCode()>;

/// One option, flag or positional of a command. What is set here returns the option again.
class Option {
  public:
    explicit Option(CLI::Option* option) : option_(option) {}

    /// What help calls its value.
    Option& type(const std::string& name);
    /// A number in [least, greatest]; not-a-number is none.
    Option& number_between(double least, double greatest);
    /// A whole number in [0, greatest].
    Option& whole_number(std::uint64_t greatest);
    Option& one_of(const std::vector<std::string>& names);
    Option& not_empty();
    /// `refusal` says what is wrong with a text; empty: nothing.
    Option& check(std::function<std::string(const std::string&)> refusal);
    Option& required();
    /// It may stand without a value, which then is `value`.
    Option& value_optional(const std::string& value = "");
    /// A file, or, without a value, "-" for stdout.
    Option& file_or_stdout() { return value_optional("-").type("[FILE]"); }
    Option& only_with(const Option& other);
    Option& not_with(const Option& other);
    /// Not in the help.
    Option& hidden();

    /// Whether it stood on the command line; known once that is parsed.
    [[nodiscard]] bool given() const;

  private:
    CLI::Option* option_;
};

/// One command: copies are the same one, which lives as long as its CommandLine.
class Command {
  public:
    Command(CLI::App* app, Action* chosen) : app_(app), chosen_(chosen) {}

    /// A command within this one.
    Command command(const std::string& name, const std::string& meaning);
    /// `name`: --NAME, or NAME alone for a positional. `value` keeps what it is if the option is
    /// not given, and must live until the command line is parsed. A vector: the option may be
    /// repeated; a positional takes all words that are left. Value: std::string, double, unsigned,
    /// std::uint64_t, std::vector<std::string>, or std::optional of std::string, std::int64_t,
    /// unsigned or double.
    template <typename Value>
    Option option(const std::string& name, Value& value, const std::string& meaning);
    Option flag(const std::string& name, bool& value, const std::string& meaning);
    /// What is done if this command is chosen.
    void does(Action action);
    /// Not in the help, and no suggestion.
    void hide();
    /// One of the commands within must be chosen.
    void require_command();

  private:
    CLI::App* app_;
    Action* chosen_;
};

/// The command line's own answer, in whole lines: help (ExitCode::Ok), or what is wrong with it
/// (ExitCode::Usage).
struct Reply {
    ExitCode code = ExitCode::Ok;
    std::string text;
};

/// Writes it, to stdout if all is well, else to stderr, and gives its code.
ExitCode say(const Reply& reply);

/// A program's commands and options.
class CommandLine {
  public:
    CommandLine(const std::string& name, const std::string& meaning);
    ~CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    /// The program itself.
    [[nodiscard]] Command program();
    /// What --version says.
    void set_version(const std::string& text);

    /// Sets what the options name and gives the action of the chosen command, if it has one.
    /// `words`: those after the program's name. @throws SetupError (Usage) for a command, option or
    /// word that is not known
    [[nodiscard]] std::expected<Action, Reply> parse(const std::vector<std::string>& words);

  private:
    std::unique_ptr<CLI::App> app_;
    Action chosen_;
};

}  // namespace gazeloop::cli
