#include "runtime/study/responses_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "runtime/open_for_reading.h"
#include "runtime/study/decisions.h"

namespace gazeloop::study {
namespace {

constexpr std::size_t kLargestFile = std::size_t{64} << 20U;

std::string head_of(const Plan& plan) {
    std::string head = "subject,trial,attempt,session,kind,first";
    for (const Factor& factor : plan.factors) {
        head += "," + factor.name;
    }
    return head + ",answer,after_s,settled,fault";
}

std::vector<std::string_view> cells_of(std::string_view line) {
    std::vector<std::string_view> cells;
    for (;;) {
        const std::size_t comma = line.find(',');
        cells.push_back(line.substr(0, comma));
        if (comma == std::string_view::npos) {
            return cells;
        }
        line.remove_prefix(comma + 1);
    }
}

/// Takes the cells of a line in turn; what is wrong with one is kept.
class Cells {
  public:
    explicit Cells(std::string_view line) : cells_(cells_of(line)) {}
    [[nodiscard]] std::size_t count() const { return cells_.size(); }

    unsigned whole(std::string_view what) {
        unsigned value = 0;
        parse(what, value);
        return value;
    }
    double number(std::string_view what) {
        double value = 0.0;
        if (parse(what, value) && !std::isfinite(value)) {
            fail(what);
        }
        return value;
    }
    std::optional<double> number_or_empty(std::string_view what) {
        if (cells_[at_].empty()) {
            ++at_;
            return std::nullopt;
        }
        return number(what);
    }
    template <typename Enum, std::size_t Count>
    Enum name(std::string_view what, const std::array<std::string_view, Count>& names) {
        const std::string_view text = cells_[at_++];
        const auto found = std::ranges::find(names, text);
        if (found == names.end()) {
            wrong_.empty() ? void(wrong_ = fmt::format("'{}' is no {}", text, what)) : void();
            return Enum{};
        }
        return static_cast<Enum>(found - names.begin());
    }
    [[nodiscard]] const std::string& wrong() const { return wrong_; }

  private:
    template <typename T>
    bool parse(std::string_view what, T& value) {
        const std::string_view text = cells_[at_];
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc{} || end != text.data() + text.size()) {
            fail(what);
            return false;
        }
        ++at_;
        return true;
    }
    void fail(std::string_view what) {
        if (wrong_.empty()) {
            wrong_ = fmt::format("'{}' is no {}", cells_[std::min(at_, cells_.size() - 1)], what);
        }
        ++at_;
    }

    std::vector<std::string_view> cells_;
    std::size_t at_ = 0;
    std::string wrong_;
};

enum class First : std::uint8_t { Reference, Test };
constexpr std::array<std::string_view, 2> kFirstNames{"reference", "test"};

Expected<Response> response_of(const Plan& plan, std::string_view line) {
    const auto bad = [](std::string what) {
        return std::unexpected(Error{ErrorKind::BadInput, std::move(what)});
    };
    Cells cells(line);
    if (cells.count() != plan.factors.size() + 10) {
        return bad(
            fmt::format("{} cells where {} are expected", cells.count(), plan.factors.size() + 10));
    }
    Response response;
    response.subject = cells.whole("subject's number");
    response.trial.number = cells.whole("trial's number");
    response.attempt = cells.whole("number of attempts");
    response.trial.session = cells.whole("session's number");
    response.trial.kind = cells.name<TrialKind>("kind", kTrialKindNames);
    response.trial.reference_first =
        cells.name<First>("reference or test", kFirstNames) == First::Reference;
    for (const Factor& factor : plan.factors) {
        if (const auto level = cells.number_or_empty("level of " + factor.name)) {
            response.trial.levels.push_back(*level);
        }
    }
    response.answer = cells.name<Answer>("answer", kAnswerNames);
    response.after_s = cells.number("time");
    response.settled = cells.number_or_empty("level");
    response.fault = cells.name<TrialFault>("fault", kTrialFaultNames);
    if (!cells.wrong().empty()) {
        return bad(cells.wrong());
    }
    if (auto checked = check_response(plan, response); !checked) {
        return std::unexpected(checked.error());
    }
    return response;
}

}  // namespace

Expected<void> check_response(const Plan& plan, const Response& response) {
    const auto bad = [](std::string what) {
        return std::unexpected(Error{ErrorKind::BadInput, std::move(what)});
    };
    if (response.subject == 0) {
        return bad("subjects are numbered from 1");
    }
    if (!answers(plan.design, response.answer)) {
        return bad(fmt::format("the design {} has no answer '{}'",
                               kDesignNames[static_cast<std::size_t>(plan.design)],
                               kAnswerNames[static_cast<std::size_t>(response.answer)]));
    }
    if (response.trial.kind == TrialKind::Validation && !plan.reference_varies()) {
        return response.trial.levels.empty() ? Expected<void>{}
                                             : bad("a validation trial has no levels");
    }
    if (response.trial.levels.size() != plan.factors.size()) {
        return bad(fmt::format("{} levels where the plan has {} factors",
                               response.trial.levels.size(), plan.factors.size()));
    }
    for (std::size_t at = 0; at < plan.factors.size(); ++at) {
        const Factor& factor = plan.factors[at];
        if (std::ranges::find(factor.levels, response.trial.levels[at]) == factor.levels.end()) {
            return bad(fmt::format("{} is no level of {} in the plan", response.trial.levels[at],
                                   factor.name));
        }
    }
    return {};
}

std::string responses_csv(const Plan& plan, std::span<const Response> responses) {
    std::string csv = head_of(plan) + "\n";
    for (const Response& response : responses) {
        const Trial& trial = response.trial;
        csv += fmt::format("{},{},{},{},{},{}", response.subject, trial.number, response.attempt,
                           trial.session, kTrialKindNames[static_cast<std::size_t>(trial.kind)],
                           kFirstNames[trial.reference_first ? 0 : 1]);
        for (std::size_t at = 0; at < plan.factors.size(); ++at) {
            csv += at < trial.levels.size() ? fmt::format(",{}", trial.levels[at]) : ",";
        }
        csv += fmt::format(
            ",{},{},{},{}\n", kAnswerNames[static_cast<std::size_t>(response.answer)],
            response.after_s, response.settled ? fmt::format("{}", *response.settled) : "",
            kTrialFaultNames[static_cast<std::size_t>(response.fault)]);
    }
    return csv;
}

Expected<std::vector<Response>> responses_of(const Plan& plan, std::string_view csv,
                                             std::string_view name) {
    std::vector<Response> responses;
    std::size_t number = 0;
    while (!csv.empty()) {
        ++number;
        const std::size_t end = csv.find('\n');
        std::string_view line = csv.substr(0, end);
        csv.remove_prefix(end == std::string_view::npos ? csv.size() : end + 1);
        if (line.ends_with('\r')) {
            line.remove_suffix(1);
        }
        const auto bad = [&](std::string_view what) {
            return std::unexpected(
                Error{ErrorKind::BadInput, fmt::format("{}:{}: {}", name, number, what)});
        };
        if (number == 1) {
            if (line != head_of(plan)) {
                return bad(fmt::format("these are not answers to this plan, whose first line is {}",
                                       head_of(plan)));
            }
            continue;
        }
        if (line.empty()) {
            continue;
        }
        auto response = response_of(plan, line);
        if (!response) {
            return bad(response.error().message);
        }
        responses.push_back(std::move(*response));
    }
    if (number == 0) {
        return std::unexpected(Error{ErrorKind::BadInput, fmt::format("{}: is empty", name)});
    }
    return responses;
}

Expected<std::vector<Response>> read_responses(const Plan& plan,
                                               const std::filesystem::path& file) {
    auto in = open_for_reading(file);
    if (!in) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("{}: answers cannot be read ({})", file.string(), in.error())});
    }
    std::string text((std::istreambuf_iterator<char>(*in)), std::istreambuf_iterator<char>());
    if (text.size() > kLargestFile) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("{}: is larger than any study's answers (64 MiB)", file.string())});
    }
    return responses_of(plan, text, file.string());
}

}  // namespace gazeloop::study
