#include "runtime/study/plan_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "runtime/open_for_reading.h"
#include "runtime/settings/nearest_name.h"

namespace gazeloop::study {
namespace {

constexpr std::string_view kFormat = "gazeloop-study";
constexpr std::int64_t kVersion = 1;

/// Thrown within this file alone: what is wrong, and where.
struct PlanError {
    std::uint32_t line = 0;  ///< 0: of the file as a whole
    std::string what;
};

std::string toml_text(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') {
            out += fmt::format("\\u{:04X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
        } else {
            out += c;
        }
    }
    return out + '"';
}

/// As TOML's real numbers, in the fewest digits that are read back to the same bits.
std::string real(double value) {
    std::string text = fmt::format("{}", value);
    return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string reals(const std::vector<double>& values) {
    std::vector<std::string> texts(values.size());
    std::ranges::transform(values, texts.begin(), real);
    return fmt::format("[{}]", fmt::join(texts, ", "));
}

std::string texts(const std::vector<std::string>& values) {
    std::vector<std::string> list(values.size());
    std::ranges::transform(values, list.begin(), toml_text);
    return fmt::format("[{}]", fmt::join(list, ", "));
}

/// Reads a table key by key, and knows in the end which keys it was not asked for.
class TableKeys {
  public:
    TableKeys(const toml::table& table, std::string where)
        : table_(table), where_(std::move(where)) {}

    void read(std::string_view key, std::string& value) {
        if (const toml::node* const node = find(key)) {
            value = as<std::string>(*node, key, "a text");
        }
    }
    void read(std::string_view key, bool& value) {
        if (const toml::node* const node = find(key)) {
            value = as<bool>(*node, key, "true or false");
        }
    }
    void read(std::string_view key, double& value) {
        if (const toml::node* const node = find(key)) {
            value = number(*node, key);
        }
    }
    void read(std::string_view key, unsigned& value) {
        if (const toml::node* const node = find(key)) {
            value = static_cast<unsigned>(whole(*node, key, std::numeric_limits<unsigned>::max()));
        }
    }
    void read(std::string_view key, std::uint64_t& value) {
        if (const toml::node* const node = find(key)) {
            value = static_cast<std::uint64_t>(
                whole(*node, key, std::numeric_limits<std::int64_t>::max()));
        }
    }
    void read(std::string_view key, std::vector<double>& values) {
        if (const toml::array* const array = list(key)) {
            values.clear();
            for (const toml::node& node : *array) {
                values.push_back(number(node, key));
            }
        }
    }
    void read(std::string_view key, std::vector<std::string>& values) {
        if (const toml::array* const array = list(key)) {
            values.clear();
            for (const toml::node& node : *array) {
                values.push_back(as<std::string>(node, key, "a list of texts"));
            }
        }
    }
    template <std::size_t Count, typename Enum>
    void read(std::string_view key, const std::array<std::string_view, Count>& names, Enum& value) {
        const toml::node* const node = find(key);
        if (node == nullptr) {
            return;
        }
        const auto text = as<std::string>(*node, key, "a text");
        const auto found = std::ranges::find(names, text);
        if (found == names.end()) {
            const std::vector<std::string> known(names.begin(), names.end());
            throw PlanError{node->source().begin.line, settings::unknown_name(key, text, known)};
        }
        value = static_cast<Enum>(found - names.begin());
    }
    const toml::table* table(std::string_view key) {
        const toml::node* const node = find(key);
        if (node != nullptr && node->as_table() == nullptr) {
            throw PlanError{node->source().begin.line,
                            fmt::format("{}{} is no table", where_, key)};
        }
        return node != nullptr ? node->as_table() : nullptr;
    }
    const toml::array* list(std::string_view key) {
        const toml::node* const node = find(key);
        if (node != nullptr && node->as_array() == nullptr) {
            throw PlanError{node->source().begin.line, fmt::format("{}{} is no list", where_, key)};
        }
        return node != nullptr ? node->as_array() : nullptr;
    }
    /// Where a key stands; 0: nowhere.
    [[nodiscard]] std::uint32_t line(std::string_view key) const {
        const toml::node* const node = table_.get(key);
        return node != nullptr ? node->source().begin.line : 0;
    }
    /// Refuses what nobody asked for.
    void end() const {
        for (const auto& [key, node] : table_) {
            if (!asked_.contains(key.str())) {
                std::vector<std::string> known(asked_.begin(), asked_.end());
                for (std::string& one : known) {
                    one.insert(0, where_);
                }
                throw PlanError{
                    key.source().begin.line,
                    settings::unknown_name("key", where_ + std::string(key.str()), known)};
            }
        }
    }

  private:
    const toml::node* find(std::string_view key) {
        asked_.emplace(key);
        return table_.get(key);
    }
    template <typename T>
    T as(const toml::node& node, std::string_view key, std::string_view kind) const {
        const auto value = node.value_exact<T>();
        if (!value) {
            throw PlanError{node.source().begin.line,
                            fmt::format("{}{} must be {}", where_, key, kind)};
        }
        return *value;
    }
    double number(const toml::node& node, std::string_view key) const {
        const auto value = node.is_number() ? node.value<double>() : std::nullopt;
        if (!value) {
            throw PlanError{node.source().begin.line,
                            fmt::format("{}{} must be a number", where_, key)};
        }
        return *value;
    }
    std::int64_t whole(const toml::node& node, std::string_view key, std::int64_t most) const {
        const auto value = node.value_exact<std::int64_t>();
        if (!value || *value < 0 || *value > most) {
            throw PlanError{node.source().begin.line,
                            fmt::format("{}{} must be a whole number from 0 on", where_, key)};
        }
        return *value;
    }

    const toml::table& table_;
    std::string where_;
    std::set<std::string, std::less<>> asked_;
};

/// A setting that a plan's pictures have, and where the plan says so.
struct PlannedSetting {
    std::string key;
    std::string text;
    std::uint32_t line = 0;  ///< 0: the plan leaves it open
};

Factor factor_of(const toml::table& table) {
    Factor factor;
    TableKeys keys(table, "factor.");
    keys.read("name", factor.name);
    keys.read("key", factor.key);
    keys.read("levels", factor.levels);
    keys.read("values", factor.values);
    keys.read("quotient", factor.quotient);
    keys.read("by_session", factor.by_session);
    keys.end();
    return factor;
}

/// What `scenes = [...]` is short for.
Factor scene_factor(std::vector<std::string> scenes) {
    Factor factor{.name = "scene", .key = "render.scene", .levels = {}, .values = {}};
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        factor.levels.push_back(static_cast<double>(i + 1));
    }
    factor.values = std::move(scenes);
    factor.by_session = true;
    return factor;
}

/// What a factor's levels set. Those that are not as many as the levels are refused by check().
void add_levels(const Factor& factor, std::uint32_t line, std::vector<PlannedSetting>& settings) {
    if (factor.key.empty() ||
        (!factor.values.empty() && factor.values.size() != factor.levels.size())) {
        return;
    }
    for (const double level : factor.levels) {
        settings.push_back({factor.key, factor.value_of(level), line});
    }
}

void read_gaze(const toml::table& table, GazeRules& gaze) {
    TableKeys keys(table, "gaze.");
    keys.read("follow", gaze.follow);
    keys.read("target_deg", gaze.target_deg);
    keys.read("most_off_s", gaze.most_off_s);
    keys.read("most_lost_s", gaze.most_lost_s);
    keys.read("most_attempts", gaze.most_attempts);
    keys.end();
}

/// `settings` gets all that the plan sets.
Plan plan_of_table(const toml::table& table, std::vector<PlannedSetting>& settings) {
    Plan plan;
    std::string format;
    std::uint64_t version = 0;
    TableKeys keys(table, "");
    keys.read("format", format);
    keys.read("version", version);
    if (format != kFormat) {
        throw PlanError{keys.line("format"),
                        fmt::format("is no study: format = \"{}\" is missing", kFormat)};
    }
    if (version != kVersion) {
        throw PlanError{
            keys.line("version"),
            keys.line("version") == 0
                ? fmt::format("version = {} is missing", kVersion)
                : fmt::format("version = {} is not known: this program reads version {}; take the "
                              "program that wrote the study, or write it for version {}",
                              version, kVersion, kVersion)};
    }
    keys.read("name", plan.name);
    keys.read("source", plan.source);
    keys.read("design", kDesignNames, plan.design);
    keys.read("method", plan.method);
    keys.read("reference_method", plan.reference_method);
    keys.read("higher_is_better", plan.higher_is_better);
    keys.read("logarithmic", plan.logarithmic);
    keys.read("criterion", plan.criterion);
    std::vector<std::string> scenes;
    keys.read("scenes", scenes);
    keys.read("subjects", plan.subjects);
    keys.read("sessions", plan.sessions);
    keys.read("repeats", plan.repeats);
    keys.read("training", plan.training);
    keys.read("validation", plan.validation);
    keys.read("most_failed", plan.most_failed);
    keys.read("shown_s", plan.shown_s);
    keys.read("black_s", plan.black_s);
    keys.read("answer_s", plan.answer_s);
    keys.read("rest_s", plan.rest_s);
    keys.read("steps", plan.steps);
    keys.read("seed", plan.seed);
    for (const auto& [key, method] : {std::pair{"method", &plan.method},
                                      std::pair{"reference_method", &plan.reference_method}}) {
        settings.push_back({"render.method", *method, keys.line(key)});
    }
    if (const toml::table* const of_all = keys.table("settings")) {
        for (const auto& [key, node] : *of_all) {
            const auto text = node.value_exact<std::string>();
            if (!text) {
                throw PlanError{
                    node.source().begin.line,
                    fmt::format("settings.{} must be a text, as --set takes it", key.str())};
            }
            plan.settings.emplace_back(key.str(), *text);
            settings.push_back({std::string(key.str()), *text, key.source().begin.line});
        }
    }
    if (const toml::table* const gaze = keys.table("gaze")) {
        read_gaze(*gaze, plan.gaze);
    }
    if (const toml::array* const factors = keys.list("factor")) {
        for (const toml::node& node : *factors) {
            if (node.as_table() == nullptr) {
                throw PlanError{node.source().begin.line, "factor must be written [[factor]]"};
            }
            plan.factors.push_back(factor_of(*node.as_table()));
            add_levels(plan.factors.back(), TableKeys(*node.as_table(), "").line("key"), settings);
        }
    }
    keys.end();
    if (!scenes.empty()) {
        plan.factors.push_back(scene_factor(std::move(scenes)));
        add_levels(plan.factors.back(), keys.line("scenes"), settings);
    }
    return plan;
}

}  // namespace

std::string plan_text(const Plan& plan) {
    std::string text = fmt::format(
        "# A study: gazeloop study run runs it for one subject, study power says what it finds.\n"
        "format = \"{}\"\nversion = {}\nname = {}\nsource = {}\ndesign = \"{}\"\nmethod = {}\n"
        "reference_method = {}\nhigher_is_better = {}\nlogarithmic = {}\ncriterion = {}\n"
        "subjects = {}\nsessions = {}\nrepeats = {}\ntraining = {}\nvalidation = {}\n"
        "most_failed = {}\nshown_s = {}\nblack_s = {}\nanswer_s = {}\nrest_s = {}\nsteps = {}\n"
        "seed = {}\n",
        kFormat, kVersion, toml_text(plan.name), toml_text(plan.source),
        kDesignNames[static_cast<std::size_t>(plan.design)], toml_text(plan.method),
        toml_text(plan.reference_method), plan.higher_is_better, plan.logarithmic,
        real(plan.criterion), plan.subjects, plan.sessions, plan.repeats, plan.training,
        real(plan.validation), real(plan.most_failed), real(plan.shown_s), real(plan.black_s),
        real(plan.answer_s), real(plan.rest_s), plan.steps, plan.seed);
    text += fmt::format(
        "\n[gaze]\nfollow = {}\ntarget_deg = {}\nmost_off_s = {}\nmost_lost_s = {}\n"
        "most_attempts = {}\n",
        plan.gaze.follow, real(plan.gaze.target_deg), real(plan.gaze.most_off_s),
        real(plan.gaze.most_lost_s), plan.gaze.most_attempts);
    text += "\n[settings]\n";
    for (const auto& [key, value] : plan.settings) {
        text += fmt::format("{} = {}\n", toml_text(key), toml_text(value));
    }
    for (const Factor& factor : plan.factors) {
        text += fmt::format("\n[[factor]]\nname = {}\nkey = {}\nlevels = {}\n",
                            toml_text(factor.name), toml_text(factor.key), reals(factor.levels));
        if (!factor.values.empty()) {
            text += fmt::format("values = {}\n", texts(factor.values));
        }
        if (factor.by_session) {
            text += "by_session = true\n";
        }
        if (factor.quotient != 0.0) {
            text += fmt::format("quotient = {}\n", real(factor.quotient));
        }
    }
    return text;
}

Expected<Plan> plan_of(std::string_view text, std::string_view name, settings::Settings* known) {
    const auto place = [name](std::uint32_t line) {
        return line > 0 ? fmt::format("{}:{}", name, line) : std::string(name);
    };
    const auto bad = [&](std::uint32_t line, std::string_view what) {
        return std::unexpected(
            Error{ErrorKind::BadInput, fmt::format("{}: {}", place(line), what)});
    };
    if (text.size() > kLargestPlan) {
        return bad(0, "is larger than any study (1 MiB)");
    }
    try {
        std::vector<PlannedSetting> settings;
        Plan plan = plan_of_table(toml::parse(text, name), settings);
        if (auto checked = check(plan); !checked) {
            return bad(0, checked.error().message);
        }
        for (const PlannedSetting& one : settings) {
            if (known == nullptr) {
                break;
            }
            if (const auto set = known->set(one.key, one.text, place(one.line)); !set) {
                return std::unexpected(Error{ErrorKind::BadInput, set.error().message});
            }
        }
        return plan;
    } catch (const toml::parse_error& error) {
        return bad(error.source().begin.line, error.description());
    } catch (const PlanError& error) {
        return bad(error.line, error.what);
    }
}

Expected<Plan> read_plan(const std::filesystem::path& file, settings::Settings* known) {
    auto in = open_for_reading(file);
    if (!in) {
        return std::unexpected(Error{
            ErrorKind::BadInput,
            fmt::format("{}: the study cannot be read ({}); gazeloop study plan NAME writes one",
                        file.string(), in.error())});
    }
    std::string text(kLargestPlan + 1, '\0');
    in->read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in->gcount()));
    return plan_of(text, file.string(), known);
}

}  // namespace gazeloop::study
